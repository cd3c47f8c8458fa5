// Reports of 'defray validate' on results made by hand: what was found stands where one looks.
#include <cmath>
#include <nlohmann/json.hpp>

#include "support.h"
#include "validation/arithmetic.h"
#include "validation/report.h"
#include "validation/worst_picture.h"

namespace defray::test::validation_report_test {
namespace {

using namespace defray::validation;
using nlohmann::json;
using Row = std::vector<std::string>;

KernelResult kernel_named(const std::string& name) {
  KernelResult k;
  k.kernel = name;
  k.rule = "equal";
  k.cases = 12;
  k.verdict.compared = 3400;
  k.seconds = 1.25;
  k.hash = 0xabc;
  return k;
}

/// One kernel of each kind: passed, wrong floats, wrong whole numbers, other bits, an error.
DeviceResult findings() {
  DeviceResult d;
  d.device = "device";
  d.platform = "platform";
  d.version = "1.2";
  d.math = "strict";
  for (const char* name : {"good", "floats", "whole", "unstable", "broken"}) {
    d.kernels.push_back(kernel_named(name));
  }
  KernelResult &good = d.kernels[0], &floats = d.kernels[1], &whole = d.kernels[2];
  good.verdict.ulp_histogram[0] = 3400;
  good.verdict.exact_share = 0.125;
  floats.verdict.differing = 7;
  floats.verdict.wrong = 5;
  floats.verdict.worst = 3;
  floats.verdict.ulp_histogram[0] = 3393;
  floats.verdict.ulp_histogram[3] = 7;
  floats.worst_case = "13x7,ties";
  floats.first_wrong = "1x1";
  whole.verdict.differing = whole.verdict.wrong = 1;
  whole.verdict.worst = 2;
  d.kernels[3].unstable = 4;
  d.kernels[4].error = "1x1: CL_OUT_OF_RESOURCES";
  return d;
}

std::string case_command(const DeviceResult& device, const std::string& kernel,
                         const std::string& case_text) {
  return device.device + " --kernel " + kernel + " --case " + case_text;
}

const Table& table_named(const Section& section, const std::string& caption) {
  for (const Table& t : section.tables) {
    if (t.caption.find(caption) == 0) return t;
  }
  ADD_FAILURE() << "no table '" << caption << "'";
  return section.tables.front();
}

TEST(ValidationReport, TablesHoldWhatWasFound) {
  const Folder folder;
  const std::vector<Section> sections =
      to_sections({findings()}, {"a note"}, folder.path(), case_command);
  ASSERT_EQ(sections.size(), 2u);
  ASSERT_EQ(sections[0].findings.size(), 2u);
  EXPECT_EQ(sections[0].findings.front(), "a note");
  for (const char* word : {"'worst'", "'Share of the exact bound'", "'Unstable'", "'Hash'"}) {
    EXPECT_NE(sections[0].findings[1].find(word), std::string::npos) << "tells what it means";
  }
  const Table& summary = sections[0].tables.front();
  EXPECT_EQ(summary.columns, (Row{"kernel", "device"}));
  std::string results;
  for (const Row& row : summary.rows) results += row[0] + " " + row[1] + "; ";
  EXPECT_EQ(results, "good PASS; floats FAIL; whole FAIL; unstable FAIL; broken FAIL; ");
  const DeviceResult d = findings();
  EXPECT_EQ(sections[1].findings[0],
            d.platform + ", " + d.version + "; " + d.math + " arithmetic. NOT all pass.");
  const Table& kernels = table_named(sections[1], "Kernels against");
  const std::string hash = "0000000000000abc";
  EXPECT_EQ(kernels.rows[0],
            (Row{"good", "PASS", "equal", "12", "3400", "0", "0", "0", "0.125", "0", "1.2", hash}));
  EXPECT_EQ(kernels.rows[1], (Row{"floats", "FAIL", "equal", "12", "3400", "7", "5", "3 ulp", "-",
                                  "0", "1.2", hash}));
  EXPECT_EQ(kernels.rows[2],
            (Row{"whole", "FAIL", "equal", "12", "3400", "1", "1", "2", "-", "0", "1.2", hash}));
  const Table& again = table_named(sections[1], "Cases to run again");
  ASSERT_EQ(again.rows.size(), 3u);
  EXPECT_EQ(again.rows[0][1], "largest difference");
  EXPECT_NE(again.rows[0][2].find("--kernel floats --case 13x7,ties"), std::string::npos);
  EXPECT_NE(again.rows[1][2].find("--kernel floats --case 1x1"), std::string::npos);
  EXPECT_EQ(again.rows[2], (Row{"broken", "OpenCL error", "1x1: CL_OUT_OF_RESOURCES"}));
  const Table& distances = table_named(sections[1], "Distances");
  EXPECT_EQ(distances.columns, (Row{"kernel", "0", "1", "2", "3-4"}));
  EXPECT_EQ(distances.rows,
            (std::vector<Row>{{"good", "3400", "0", "0", "0"}, {"floats", "3393", "0", "0", "7"}}));
}

TEST(ValidationReport, WithoutFindingsThereAreNoTablesOfThem) {
  DeviceResult d = findings();
  d.kernels = {kernel_named("whole")};
  const Folder folder;
  const std::vector<Section> sections = to_sections({d}, {}, folder.path(), case_command);
  EXPECT_EQ(sections[1].tables.size(), 1u);
  EXPECT_TRUE(sections[1].figures.empty());
  EXPECT_EQ(sections[1].findings.size(), 1u);
  EXPECT_NE(sections[1].findings[0].find("All kernels pass"), std::string::npos);
  d.math = "fast";
  d.watch = "races";
  EXPECT_EQ(to_sections({d}, {}, folder.path(), case_command)[1].findings.size(), 3u);
}

TEST(ValidationReport, JsonHoldsWhatWasFound) {
  const json all = json::parse(to_json({findings()}, {"a note"}, "full", case_command));
  EXPECT_EQ(all["level"], "full");
  EXPECT_EQ(all["notes"], json{"a note"});
  const json& device = all["devices"][0];
  EXPECT_EQ(device["passed"], false);
  const json &good = device["kernels"][0], &floats = device["kernels"][1],
             &whole = device["kernels"][2];
  EXPECT_EQ(good["passed"], true);
  EXPECT_EQ(good["ulp_histogram"], (json{{"0", 3400}}));
  EXPECT_FALSE(good.contains("worst_case") || good.contains("first_wrong") ||
               good.contains("error"));
  EXPECT_EQ(floats["passed"], false);
  EXPECT_EQ(floats["beyond_rule"], 5);
  EXPECT_EQ(floats["worst_unit"], "ulp");
  EXPECT_EQ(floats["ulp_histogram"], (json{{"0", 3393}, {"3-4", 7}}));
  EXPECT_EQ(floats["worst_case"], "device --kernel floats --case 13x7,ties");
  EXPECT_EQ(floats["first_wrong"], "device --kernel floats --case 1x1");
  EXPECT_EQ(whole["worst_unit"], "integer");
  EXPECT_FALSE(whole.contains("ulp_histogram"));
  EXPECT_EQ(device["kernels"][3]["unstable_cases"], 4);
  EXPECT_EQ(device["kernels"][4]["error"], "1x1: CL_OUT_OF_RESOURCES");
}

/// Values 0, 1, 2, ... of the twin; the kernel's are one more at a place, here in the second plane.
TEST(WorstPicture, ShowsThePlaneThatHoldsTheWorstValue) {
  const Case c = parse_case("4x60");
  validation::Run run;
  std::vector<std::int64_t> integers(240);
  Plane first(240, 7), second(240);
  for (std::size_t i = 0; i < 240; ++i) second[i] = static_cast<float>(i);
  run.twin = run.kernel = {integers, {first, second}};
  run.kernel.planes[1][9] += 1000;
  const auto picture = worst_picture(c, run, 240 + 240 + 9);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->height, 240);
  EXPECT_EQ(picture->case_text, to_string(c));
  ASSERT_EQ(picture->panels.size(), 3u);
  const auto at = [&](std::size_t panel, int x, int y) {
    return picture->panels[panel].planes[0][static_cast<std::size_t>(y * picture->width + x)];
  };
  // Pixels are squares of 4 a side; 9 is the second of the third row.
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < picture->width; ++x) {
      const int pixel = y / 4 * 4 + x / 4;
      const bool is_worst = pixel == 9, is_white = x >= 16;
      EXPECT_EQ(at(2, x, y), is_white || is_worst ? 1.0f : 0.0f) << x << " " << y;
      EXPECT_NEAR(at(1, x, y), is_white ? 1.0 : pixel / 239.0, 1e-6);
      EXPECT_NEAR(at(0, x, y), is_white || is_worst ? 1.0 : pixel / 1009.0, 1e-6);
    }
  }
  // Among whole numbers; and values that are no picture.
  run.kernel.integers[3] = 5;
  ASSERT_TRUE(worst_picture(c, run, 3));
  EXPECT_EQ(worst_picture(c, run, 3)->panels[2].planes[0][12], 1.0f);
  run.kernel.integers.resize(239);
  EXPECT_FALSE(worst_picture(c, run, 3));
  run.kernel.planes[1][0] = -HUGE_VALF;  // stretches nothing
  run.kernel.integers.resize(240);
  const auto infinite = worst_picture(c, run, 489);
  EXPECT_NEAR(infinite->panels[0].planes[0][size(4 * infinite->width)], 4 / 1009.0, 1e-6);
  run.kernel.planes[1][0] = -91;  // the darkest, 0 no longer
  const Plane negative = worst_picture(c, run, 489)->panels[0].planes[0];
  EXPECT_EQ(negative[0], 0);
  EXPECT_NEAR(negative[size(4 * infinite->width)], (4 + 91) / 1100.0, 1e-6);
}

VariantResult variant(const std::string& name, double psnr_db, double time) {
  VariantResult r;
  r.name = name;
  r.about = "about " + name;
  MethodFigures m;
  m.method = "rdb";
  m.psnr_db = psnr_db;
  m.worst = 0.015625;
  m.changed = 0.25;
  m.is_stable = std::isinf(psnr_db);
  m.time_ratio = time;
  m.time_spread = 0.5;
  r.methods = {m};
  r.kernels = findings();
  r.kernel_time_ratio = {{"good", 0.75}};
  return r;
}

TEST(ArithmeticReport, TablesHoldWhatWasMeasured) {
  VariantResult none = variant("none", 1, 1);
  none.error = "cannot";
  none.methods.clear();
  const Folder folder;
  const Section s = to_section({variant("strict", HUGE_VAL, 1), variant("fast", 101.25, 0.5), none},
                               folder.path());
  EXPECT_EQ(s.findings,
            (Row{"strict: about strict", "fast: about fast", "none: not on this device: cannot"}));
  EXPECT_EQ(s.tables[0].rows,
            (std::vector<Row>{{"strict", "rdb", "x 1.00", "0.50", "equal", "0.016", "25.00", "yes"},
                              {"fast", "rdb", "x 0.50", "0.50", "101.2", "0.016", "25.00", "no"}}));
  EXPECT_EQ(s.tables[1].rows.size(), 15u);
  EXPECT_EQ(s.tables[1].rows[0], (Row{"strict", "good", "x 0.75", "kept", "0", "0", "0"}));
  EXPECT_EQ(s.tables[1].rows[1], (Row{"strict", "floats", "-", "broken", "0.206", "3", "0"}));
  EXPECT_EQ(s.tables[1].rows[3], (Row{"strict", "unstable", "-", "broken", "0", "0", "4"}));
  EXPECT_EQ(s.tables[1].rows[4][3], "error");
  EXPECT_TRUE(std::filesystem::exists(folder / s.figures.at(0).file));
}

TEST(ArithmeticReport, JsonHoldsWhatWasMeasured) {
  const json all = json::parse(
      validation::to_json({variant("strict", HUGE_VAL, 1), variant("fast", 101.25, 0.5)}));
  EXPECT_TRUE(all[0]["methods"][0]["psnr_srgb_db"].is_null());
  const json& fast = all[1];
  EXPECT_EQ(fast["variant"], "fast");
  EXPECT_EQ(fast["methods"][0], (json{{"method", "rdb"},
                                      {"time_ratio", 0.5},
                                      {"time_spread", 0.5},
                                      {"psnr_srgb_db", 101.25},
                                      {"worst", 0.015625},
                                      {"changed", 0.25},
                                      {"stable", false}}));
  EXPECT_EQ(fast["kernels"][0]["time_ratio"], 0.75);
  EXPECT_FALSE(fast["kernels"][1].contains("time_ratio"));
  EXPECT_EQ(fast["kernels"][1]["differing"], 7);
  EXPECT_EQ(fast["kernels"][3]["unstable_cases"], 4);
}

}  // namespace
}  // namespace defray::test::validation_report_test
