// 'defray validate': values held to exact arithmetic, sums over cases, hashes, and whole runs.
#include <cmath>
#include <set>

#include "numbers.h"
#include "support.h"
#include "validation/report.h"

namespace defray::test::validation_exact_test {
namespace {

using namespace defray::validation;

constexpr double u = 0x1p-24;

Verdict exactly(const Exact& exact, const Plane& source, const Outcome& kernel) {
  Input in;
  in.channels = {source};
  Verdict v;
  compare_exact(exact, in, kernel, v);
  return v;
}

TEST(ExactBound, WholeNumbersMayBeHalfAStepOff) {
  const auto whole = [](double exact, std::int64_t kernel) {
    return exactly({{{exact}}, 8}, {}, {{kernel}, {}});
  };
  EXPECT_EQ(whole(2.5, 3).wrong, 0u);
  EXPECT_EQ(whole(2.5, 2).wrong, 0u);
  EXPECT_NEAR(whole(2.5, 3).exact_share, 1, 1e-5);
  EXPECT_EQ(whole(2.4, 3).wrong, 1u);
  EXPECT_EQ(whole(-2.5, 2).wrong, 1u);
  // 8 roundings of 2^22 are 2 more.
  EXPECT_EQ(whole(0x1p22, (1 << 22) + 2).wrong, 0u);
  EXPECT_EQ(whole(0x1p22, (1 << 22) + 3).wrong, 1u);
  // Beside floats they are none of the bound's.
  EXPECT_EQ(exactly({{{1}}, 8}, {1}, {{7}, {{1}}}).wrong, 0u);
}

TEST(ExactBound, FloatsAreHeldToTheLargestInput) {
  const auto one = [](double roundings_off, const Plane& source) {
    const double exact = 1 - roundings_off * 4 * u;
    return exactly({{{exact}}, 10}, source, {{}, {{1}}});
  };
  EXPECT_EQ(one(10, {1, -4}).wrong, 0u);
  EXPECT_NEAR(one(5, {1, -4}).exact_share, 0.5, 1e-9);
  EXPECT_EQ(one(10.1, {1, -4}).wrong, 1u);
  EXPECT_EQ(one(10, {1, -3}).wrong, 1u);
  EXPECT_EQ(one(0, {1, -4}).exact_share, 0);
  EXPECT_EQ(exactly({{{1}}, 10}, {4}, {{}, {{nan}}}).wrong, 1u);
  EXPECT_EQ(exactly({{{1}}, 10}, {4}, {{}, {{infinite}}}).wrong, 1u);
  // Near 0 a rounding is half the smallest denormal.
  EXPECT_EQ(exactly({{{0}}, 10}, {0}, {{}, {{1e-44f}}}).wrong, 0u);
  EXPECT_EQ(exactly({{{0}}, 10}, {0}, {{}, {{1e-43f}}}).wrong, 1u);
}

TEST(ExactBound, InfiniteInputAndOverflowingSumsHaveNone) {
  EXPECT_EQ(exactly({{{1}}, 10}, {1, infinite}, {{}, {{7}}}).wrong, 0u);
  EXPECT_EQ(exactly({{{1}}, 10}, {1, nan}, {{}, {{7}}}).wrong, 0u);
  EXPECT_EQ(exactly({{{1}}, 10}, {1e38f}, {{}, {{infinite}}}).wrong, 0u);
  EXPECT_EQ(exactly({{{1}}, 3}, {1e38f}, {{}, {{infinite}}}).wrong, 1u);
}

TEST(Verdict, AddsUpOverCasesAndKeepsTheWorst) {
  Verdict all, one;
  one.compared = 10;
  one.differing = 3;
  one.wrong = 2;
  one.worst = 5;
  one.worst_at = 7;
  one.exact_share = 0.25;
  one.ulp_histogram[4] = 3;
  EXPECT_TRUE(all.add(one));
  one.worst_at = 8;
  EXPECT_FALSE(all.add(one));  // as far apart, but later
  one.worst = 6;
  one.exact_share = 0.125;
  EXPECT_TRUE(all.add(one));
  EXPECT_EQ(all.compared, 30u);
  EXPECT_EQ(all.differing, 9u);
  EXPECT_EQ(all.wrong, 6u);
  EXPECT_EQ(all.ulp_histogram[4], 9u);
  EXPECT_EQ(all.worst, 6);
  EXPECT_EQ(all.worst_at, 8u);
  EXPECT_EQ(all.exact_share, 0.25);
}

TEST(Verdict, HashesTellBitsApartButNoNaNs) {
  const auto hash = [](float v) { return validation::hash_of(Outcome{{}, {{v}}}); };
  EXPECT_EQ(hash(nan), hash(-nan));
  EXPECT_NE(hash(0.0f), hash(-0.0f));
  EXPECT_NE(hash(1.0f), hash(std::nextafter(1.0f, 2.0f)));
  EXPECT_NE(validation::hash_of(Outcome{{1, 2}, {}}), validation::hash_of(Outcome{{2, 1}, {}}));
}

DeviceResult validated(const std::string& kernel, const std::string& only_case,
                       const SessionOptions& options = {}) {
  Settings settings;
  settings.kernels = {kernel};
  settings.only_case = only_case;
  settings.session = options;
  return validate_device(device_under_test(), settings);
}

/// validate_device() empties Oclgrind's log, in which these tests' own findings are kept.
#define SKIP_ON_SIMULATORS() \
  if (is_slow_device()) GTEST_SKIP() << "'defray validate' itself runs on simulators"

TEST(ValidateDevice, OneCaseOfOneKernel) {
  SKIP_ON_SIMULATORS();
  const DeviceResult result = validated("rdb_merge", "13x7,ties,coc=3,channels=3");
  ASSERT_EQ(result.kernels.size(), 1u);
  const KernelResult& kernel = result.kernels[0];
  EXPECT_TRUE(result.passed());
  EXPECT_EQ(kernel.cases, 1u);
  EXPECT_EQ(kernel.verdict.compared, 13u * 7 * (3 + 1));
  EXPECT_EQ(kernel.hash, validated("rdb_merge", "13x7,ties,coc=3,channels=3").kernels[0].hash);
  EXPECT_NE(kernel.hash, validated("rdb_merge", "13x7,ties,coc=4,channels=3").kernels[0].hash);
}

/// rdb_merge without its last cell: what a broken kernel leaves in the report.
const Substitution broken_merge{"cell < p.cell_count; ++cell", "cell + 1 < p.cell_count; ++cell"};

TEST(ValidateDevice, ABrokenKernelIsNamedWithItsCaseAndPicture) {
  SKIP_ON_SIMULATORS();
  SessionOptions options;
  options.substitutions = {broken_merge};
  const DeviceResult result = validated("rdb_merge", "3x60,ties,coc=3", options);
  EXPECT_FALSE(result.passed());
  EXPECT_EQ(result.kernels[0].first_wrong, to_string(parse_case("3x60,ties,coc=3")));
  EXPECT_EQ(result.kernels[0].worst_case, result.kernels[0].first_wrong);
  ASSERT_EQ(result.pictures.size(), 1u);
  const WorstPicture& picture = result.pictures[0];
  ASSERT_EQ(picture.panels.size(), 3u);
  EXPECT_EQ(picture.height % 60, 0);
  EXPECT_GE(picture.width, 100);  // room for the caption, and no more
  EXPECT_LE(picture.width, 150);
  EXPECT_LE(picture.height, 480);  // a column is no reason for a page of thousands of rows
  for (const SheetPanel& panel : picture.panels) {
    EXPECT_EQ(panel.planes[0].size(), static_cast<std::size_t>(picture.width * picture.height));
  }
}

TEST(ValidateDevice, WorkGroupsAreTheCasesUnlessOneIsSet) {
  SKIP_ON_SIMULATORS();
  const std::pair<std::optional<int>, std::string> groups[] = {
      {{}, "group=7x3"}, {0, ""}, {1, "group=1x1"}, {16, "group=16x1"}};
  for (const auto& [set, group] : groups) {
    Settings settings;
    settings.kernels = {"rdb_merge"};
    settings.only_case = "3x60,ties,coc=3,group=7x3";
    settings.group_x = set;
    settings.session.substitutions = {broken_merge};
    const std::string wrong = validate_device(device_under_test(), settings).kernels[0].first_wrong;
    const std::size_t said = wrong.find("group=");
    EXPECT_EQ(said == wrong.npos ? "" : wrong.substr(said, group.size()), group) << wrong;
  }
}

std::string no_command(const DeviceResult&, const std::string&, const std::string&) { return ""; }

TEST(Report, DevicesKeepTheirOwnPictures) {
  SKIP_ON_SIMULATORS();
  SessionOptions options;
  options.substitutions = {broken_merge};
  const DeviceResult result = validated("rdb_merge", "3x60,ties,coc=3", options);
  const Folder folder;
  std::set<std::string> files;
  std::size_t figures = 0;
  for (const Section& section : to_sections({result, result}, {}, folder.path(), no_command)) {
    for (const Figure& figure : section.figures) {
      ++figures;
      files.insert(figure.file);
      EXPECT_TRUE(std::filesystem::exists(folder / figure.file)) << figure.file;
    }
  }
  EXPECT_EQ(figures, 4u);  // a picture and a plot each
  EXPECT_EQ(files.size(), figures);
}

TEST(Report, InfiniteErrorsAreNoObstacle) {
  DeviceResult result;
  result.kernels.resize(1);
  result.kernels[0].kernel = "rdb_merge";
  result.kernels[0].verdict.wrong = 1;
  result.exact = {{"rdb_merge", 10, 0.5},
                  {"rdb_merge", 10, std::numeric_limits<double>::infinity()}};
  const Folder folder;
  const std::vector<Section> sections = to_sections({result}, {}, folder.path(), no_command);
  EXPECT_EQ(sections[1].figures.size(), 1u);
  EXPECT_NE(to_json({result}, {}, "quick", no_command).find("\"beyond_rule\": 1"),
            std::string::npos);
}

TEST(Report, SaysWhereDevicesGiveOtherBits) {
  DeviceResult a, b;
  a.device = "a", b.device = "b";
  for (const auto& [kernel, hash, cases] :
       {std::tuple{"same", 1, 5}, {"other bits", 2, 5}, {"other cases", 1, 6}}) {
    KernelResult k;
    k.kernel = kernel;
    k.hash = 1;
    k.cases = 5;
    a.kernels.push_back(k);
    k.hash = static_cast<std::uint64_t>(hash);
    k.cases = cases;
    b.kernels.push_back(k);
  }
  const Folder folder;
  const Table summary = to_sections({a, b}, {}, folder.path(), no_command).front().tables.front();
  ASSERT_EQ(summary.rows.size(), 3u);
  EXPECT_EQ(summary.rows[0].back(), "yes");
  EXPECT_EQ(summary.rows[1].back(), "no");
  EXPECT_EQ(summary.rows[2].back(), "no");
}

}  // namespace
}  // namespace defray::test::validation_exact_test
