// What `defray render` prints of a frame, line by line: every figure that it has, and no other.
#include "render/render_report.h"

#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::render_report_test {
namespace {

using cli::FrameOutcome;
using nlohmann::json;

/// A frame of which there is something to say everywhere.
FrameOutcome outcome() {
  FrameOutcome o;
  o.paths.input = "in.exr";
  o.paths.output = "out.exr";
  o.status = "ok";
  FrameReport& r = o.report;
  r.paths = o.paths;
  r.colour_channels = {"R", "G", "B"};
  r.light_channels = {"diffuse.R"};
  r.data_channels = {"id", "N.X"};
  r.depth_channel = "Z";
  r.data = {1, 2, 30, 20};
  r.display = {0, 0, 64, 48};
  r.lens.focal_length_mm = 50;
  r.lens.aperture_diameter_mm = 25;
  r.lens.sensor_width_mm = 36;
  r.lens.focus_distance_units = 3;
  r.lens.metres_per_unit = 0.01;
  r.depth.nearest_units = 1.5;
  r.depth.farthest_units = 9;
  r.depth.background = 7;
  r.depth.not_a_number = 2;
  r.depth.outside_range = 3;
  r.nearest_coc_px = -4.5;
  r.farthest_coc_px = 12.25;
  r.coc_limited = 5;
  r.nonfinite = 6;
  r.notes = {"a note"};
  r.read_seconds = 0.5;
  r.render_seconds = 1.25;
  r.write_seconds = 0.125;
  ChainReport chain;
  chain.repaired = 11;
  chain.behind = 12;
  chain.split = 13;
  chain.highlights = 14;
  chain.interpolated = 16;
  chain.border_px = 15;
  chain.border_is_cut = true;
  chain.lens_points = 137;
  chain.confidence = 0.75;
  chain.stages = {{"lens", 0.25, 0}, {"rays", 0.5, 3 << 19}};
  chain.tiles = {8, 0.5, 0.25, 0.125, 0.0625, 0.03125};
  r.chain = chain;
  r.predict_seconds = 0.0625;
  r.tuned = {"coc=8x1", "fill=16x2"};
  r.budget = BudgetChoice{Quality::draft, 11, 1125.5, 1200};
  r.expected = ExpectedError{40.25, 36, 46, {0.5, 0.25, 0.125, 0.125}, {}, 0, false};
  return o;
}

std::string text_of(const FrameOutcome& o) {
  testing::internal::CaptureStdout();
  print_text(o, cli::notes_of(o.report), "device");
  std::fflush(stdout);
  return testing::internal::GetCapturedStdout();
}

json json_of(const FrameOutcome& o) {
  testing::internal::CaptureStdout();
  print_json_line(o, "device");
  return json::parse(testing::internal::GetCapturedStdout());
}

TEST(RenderReport, TextHasEveryFigure) {
  EXPECT_EQ(
      text_of(outcome()),
      "in.exr -> out.exr\n"
      "  colour R G B, depth Z, 1.5 to 9 units, background 7 px (2 of them NaN)\n"
      "  light diffuse.R\n"
      "  data of the nearest hit id N.X\n"
      "  data window 30x20+1+2, display window 64x48+0+0\n"
      "  lens 50 mm, aperture 25 mm (f/2), sensor 36 mm, focus 3 units of 0.01 m\n"
      "  CoC radius -4.5 to 12.25 px\n"
      "  137 lens points, 75.00 % of their rays determined by the input, 12 px made up behind, "
      "13 px split, 14 highlights, 16 px between rows\n"
      "  --quality draft --rdb 11: 1126 ms expected, 1250 taken, of 1200\n"
      "  expected 40.2 dB (36.0 to 46.0); of the error 50 % sampling, 25 % hidden, 12 % edges, "
      "12 % detail\n"
      "  note: a note\n"
      "  note: 6 NaN or Inf colour values set to 0\n"
      "  note: 3 stored depths lie outside 0...1: are they of this kind?\n"
      "  note: CoC limited in 5 px\n"
      "  note: depth looks anti-aliased: 11 px repaired (--repair off leaves them)\n"
      "  note: the border goes on for 15 px: rays from further out do not count\n"
      "  read 0.500 s, rdb 1.250 s on device, write 0.125 s\n");
}

TEST(RenderReport, TextLeavesOutWhatThereIsNot) {
  FrameOutcome o = outcome();
  FrameReport& r = o.report;
  r.light_channels = r.data_channels = r.notes = {};
  r.depth = {};
  r.depth.background = 600;
  r.lens.aperture_diameter_mm = 0;
  r.lens.pixels_per_metre = 4000;
  r.coc_limited = r.nonfinite = 0;
  r.chain = ChainReport{};
  r.expected.reset();
  r.budget.reset();
  r.chain->lens_points = 9;
  EXPECT_EQ(text_of(o),
            "in.exr -> out.exr\n"
            "  colour R G B, depth Z, nothing but background\n"
            "  data window 30x20+1+2, display window 64x48+0+0\n"
            "  lens 50 mm, aperture 0 mm, 4000 px/m, focus 3 units of 0.01 m\n"
            "  CoC radius -4.5 to 12.25 px\n"
            "  9 lens points, 0.00 % of their rays determined by the input\n"
            "  read 0.500 s, rdb 1.250 s on device, write 0.125 s\n");
  r.depth = {};
  r.depth.nearest_units = 1;
  r.depth.farthest_units = 2;
  r.chain = {};
  r.nonfinite = 1;
  r.nonfinite_kept = true;
  EXPECT_NE(text_of(o).find("depth Z, 1 to 2 units\n"), std::string::npos) << text_of(o);
  EXPECT_NE(text_of(o).find("12.25 px\n  note: 1 NaN or Inf colour values kept\n  read"),
            std::string::npos);
  r.depth_channel = "";
  r.method = Method::tiltshift;
  EXPECT_NE(text_of(o).find("colour R G B, no depth\n  data window"), std::string::npos);
  EXPECT_EQ(text_of(o).find("lens"), std::string::npos) << text_of(o);
  o.status = "skipped";
  EXPECT_EQ(text_of(o), "out.exr: exists, skipped\n");
}

TEST(RenderReport, JsonHasEveryFigure) {
  const json expected = {
      {"status", "ok"},
      {"input", "in.exr"},
      {"output", "out.exr"},
      {"device", "device"},
      {"method", "rdb"},
      {"colour_channels", {"R", "G", "B"}},
      {"light_channels", json{"diffuse.R"}},
      {"data_channels", {"id", "N.X"}},
      {"data_window", {1, 2, 30, 20}},
      {"display_window", {0, 0, 64, 48}},
      {"depth_channel", "Z"},
      {"focal_length_mm", 50.0},
      {"aperture_diameter_mm", 25.0},
      {"sensor_width_mm", 36.0},
      {"focus_distance_units", 3.0},
      {"metres_per_unit", 0.01},
      {"nearest_units", 1.5},
      {"farthest_units", 9.0},
      {"background_px", 7},
      {"nan_depth_px", 2},
      {"depth_outside_range_px", 3},
      {"chain",
       {{"lens_points", 137},
        {"confidence", 0.75},
        {"repaired_px", 11},
        {"behind_px", 12},
        {"split_px", 13},
        {"highlights", 14},
        {"between_px", 16},
        {"border_px", 15},
        {"stages_s", {{"lens", 0.25}, {"rays", 0.5}}},
        {"stages_bytes", {{"lens", 0}, {"rays", 3 << 19}}},
        {"tiles",
         {{"count", 8},
          {"in_focus", 0.5},
          {"smooth", 0.25},
          {"mixed", 0.125},
          {"hidden", 0.0625},
          {"lights", 0.03125}}}}},
      {"expected",
       {{"psnr_srgb_db", 40.25},
        {"low_db", 36.0},
        {"high_db", 46.0},
        {"sampling", 0.5},
        {"hidden", 0.25},
        {"edges", 0.125},
        {"detail", 0.125}}},
      {"budget",
       {{"quality", "draft"}, {"rdb", 11}, {"expected_ms", 1125.5}, {"budget_ms", 1200.0}}},
      {"tuned", {"coc=8x1", "fill=16x2"}},
      {"nearest_coc_px", -4.5},
      {"farthest_coc_px", 12.25},
      {"coc_limited_px", 5},
      {"nonfinite_values", 6},
      {"notes", json{"a note"}},
      {"read_s", 0.5},
      {"render_s", 1.25},
      {"predict_s", 0.0625},
      {"write_s", 0.125}};
  EXPECT_EQ(json_of(outcome()), expected);
}

TEST(RenderReport, StatsTellOfStagesAndTiles) {
  testing::internal::CaptureStdout();
  cli::print_stats(outcome().report);
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "  stage            ms  share MiB made\n"
            "  lens          250.0   33 %      0.0\n"
            "  rays          500.0   67 %      1.5\n"
            "  tiles: 50.0 % in focus, 25.0 % smooth, 12.5 % mixed, 6.2 % with hidden "
            "surfaces, 3.1 % with lights\n"
            "  tuned: --work-group coc=8x1,fill=16x2\n");
  FrameOutcome without = outcome();
  without.report.chain.reset();
  testing::internal::CaptureStdout();
  cli::print_stats(without.report);
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(RenderReport, JsonSaysWhatBecameOfAFrame) {
  FrameOutcome o = outcome();
  o.status = "failed";
  o.error = "no \xff such file";  // no UTF-8
  o.frame = 17;
  EXPECT_EQ(json_of(o), (json{{"frame", 17},
                              {"status", "failed"},
                              {"input", "in.exr"},
                              {"output", "out.exr"},
                              {"error", "no \xef\xbf\xbd such file"}}));
  o = outcome();
  o.report.lens.pixels_per_metre = 4000;
  EXPECT_EQ(json_of(o)["pixels_per_metre"], 4000);
  EXPECT_FALSE(json_of(o).contains("sensor_width_mm") || json_of(o).contains("error") ||
               json_of(o).contains("frame"));
  o.report.depth_channel = "";
  o.report.chain = {};
  EXPECT_FALSE(json_of(o).contains("focal_length_mm") || json_of(o).contains("chain"));
}

}  // namespace
}  // namespace defray::test::render_report_test
