// 'defray validate' itself: its rules and its table. That it finds faults: faults_test.cpp.
#include "validation/validation.h"

#include <cfloat>
#include <cmath>
#include <random>
#include <set>

#include "numbers.h"
#include "support.h"
#include "validation/patterns_input.h"
#include "validation/report.h"

namespace defray::test::validation_test {
namespace {

using namespace defray::validation;

TEST(KernelChecks, EveryKernelHasAnEntryOfItsName) {
  for (Session* const s : {&session(), &session_without_int64()}) {
    const std::vector<std::string> kernels = s->kernel_names();
    EXPECT_GT(kernels.size(), 8u);
    for (const std::string& kernel : kernels) EXPECT_NO_THROW(find_check(kernel)) << kernel;
  }
}

TEST(KernelChecks, EveryEntryIsAKernelsAndItsNameIsItsOwn) {
  const std::vector<std::string> kernels = session().kernel_names();
  std::set<std::string> names;
  for (const KernelCheck& check : kernel_checks()) {
    const std::string name = check.name;
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_TRUE(std::any_of(kernels.begin(), kernels.end(), [&](const std::string& kernel) {
      return name == kernel || name.starts_with(kernel + "_");
    })) << name;
    EXPECT_NE(std::string(check.rule), "") << name;
  }
  expect_error(ErrorKind::usage, {"rdb_mrege", "Did you mean 'rdb_merge'", "tiltshift"},
               [] { find_check("rdb_mrege"); });
}

bool is_all_zero(const Outcome& values) {
  const auto is_zero = [](auto v) { return v == 0; };
  return std::all_of(values.integers.begin(), values.integers.end(), is_zero) &&
         std::all_of(values.planes.begin(), values.planes.end(), [&](const Plane& plane) {
           return std::all_of(plane.begin(), plane.end(), is_zero);
         });
}

class KernelCase : public testing::TestWithParam<const char*> {};

TEST_P(KernelCase, OfEachAgreesWithItsTwin) {
  const Case c = parse_case(GetParam());
  for (const KernelCheck& check : kernel_checks()) {
    Session& own = check.needs_two_passes ? session_without_int64() : session();
    const validation::Run run = run_case(own, check, c);
    const DeviceInfo& info = own.info();
    Verdict v = compare(check, c, run.input, run.kernel, run.twin, info.keeps_denormals,
                        info.rounds_divisions);
    if (check.exact) compare_exact(check.exact(c, run.input), run.input, run.kernel, v);
    EXPECT_GT(v.compared, 0u) << check.name;
    EXPECT_EQ(v.wrong, 0u) << check.name;
    EXPECT_TRUE(c.width < 20 || !is_all_zero(run.twin)) << check.name << " has nothing to do";
  }
  session().set_work_group(0, 0);
  session_without_int64().set_work_group(0, 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, KernelCase,
                         testing::Values("13x7,ties,coc=3,wild,channels=3,jitter,band=2,seed=5",
                                         "41x37,random,coc=3,channels=3,cells=3,band=5,seed=6"));

/// Values of a check's outcome.
struct Compared {
  explicit Compared(const char* kernel) {
    const Case c = parse_case("13x7,random,coc=3,channels=3,cells=3,seed=7");  // two layers
    const Outcome out = run_case(session(), find_check(kernel), c).kernel;
    integers = out.integers.size();
    for (const Plane& plane : out.planes) floats += plane.size();
  }
  std::size_t integers = 0, floats = 0;
};

TEST(KernelChecks, CompareAllThatAKernelWrites) {
  struct Row {
    const char* kernel;
    std::size_t integers, floats;  // a pixel
  };
  constexpr std::size_t colour = 3;
  for (const Row& row :
       {Row{"coc", 1, 0}, Row{"feather", 0, colour}, Row{"fill", 1, 1 + colour},
        Row{"gather_aware", 0, colour}, Row{"gather_literal", 0, colour}, Row{"highlights", 0, 2},
        Row{"highlights_add", 0, colour}, Row{"linear_psf", 0, colour}, Row{"mixed", 1, 0},
        Row{"patterns_match", 0, colour}, Row{"rdb_gather", 1, colour}, Row{"rdb_merge", 1, colour},
        Row{"repair", 1, 0}, Row{"soften", 0, 2 * colour}, Row{"split", 2 * 3, 2 * colour},
        Row{"tiltshift", 1, 0}}) {
    const Compared compared(row.kernel);
    EXPECT_EQ(compared.integers, 13 * 7 * row.integers) << row.kernel;
    EXPECT_EQ(compared.floats, 13 * 7 * row.floats) << row.kernel;
  }
  const Compared pad("rdb_pad");  // key, largest, sending and coverage
  EXPECT_EQ(pad.integers * colour, pad.floats * 4);
}

TEST(KernelChecks, ShowWhatPatternsChange) {
  const Case c = parse_case("41x37,random,coc=3,channels=3,seed=6");
  const validation::Run run = run_case(session(), find_check("patterns_match"), c);
  const PatternCase p(c, run.input, false);
  const auto smooth = p.behind.channels[0].host();
  EXPECT_FALSE(std::equal(smooth.begin(), smooth.end(), run.kernel.planes[0].begin()));
}

/// Copies to the device and back of one case that wants bands of so many rows.
std::size_t copies_in_bands(const KernelCheck& check, Case c, int band_rows) {
  Session& own = check.needs_two_passes ? session_without_int64() : session();
  c.band_rows = band_rows;
  const std::size_t memory = own.memory_bytes();
  const std::size_t before = own.traffic().uploads + own.traffic().downloads;
  run_kernel(own, check, c, make_input(c));
  EXPECT_EQ(own.memory_bytes(), memory) << check.name << " leaves the session as it was";
  own.set_work_group(0, 0);
  return own.traffic().uploads + own.traffic().downloads - before;
}

/// Not of those that see more where discs are large or shifts are long, `fill` by tiles and
/// `patterns_match` by cells.
TEST(KernelChecks, BandsHaveTheCasesRows) {
  const Case c = parse_case("16x48,ties,coc=0.3,cells=2,seed=2");
  for (const char* kernel :
       {"feather", "gather_literal", "mixed", "linear_psf", "rdb_merge", "rdb_nearest",
        "rdb_scatter", "rdb_scatter_two_pass", "repair", "soften", "split"}) {
    const KernelCheck& check = find_check(kernel);
    // 24, 8 and 2 bands: each takes as many copies.
    const std::size_t by_2 = copies_in_bands(check, c, 2), by_6 = copies_in_bands(check, c, 6),
                      by_24 = copies_in_bands(check, c, 24);
    EXPECT_GT(by_6, by_24) << kernel;
    EXPECT_EQ((by_2 - by_6) / (24 - 8), (by_6 - by_24) / (8 - 2)) << kernel;
    EXPECT_EQ((by_6 - by_24) % (8 - 2), 0u) << kernel;
  }
}

TEST(Validation, ProgressGoesFromKernelToKernelAndCaseToCase) {
  validation::Settings settings;
  settings.kernels = {"coc", "tiltshift"};
  std::vector<std::pair<double, std::string>> seen;
  validation::validate_device(device_under_test(), settings,
                              [&](double share, const std::string& kernel) {
                                seen.push_back({share, kernel});
                              });
  ASSERT_GT(seen.size(), 6u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [](const auto& a, const auto& b) { return a.first < b.first; }));
  EXPECT_EQ(seen.front(), std::pair(0.0, std::string("coc")));
  EXPECT_EQ(seen.back().second, "tiltshift");
  EXPECT_GT(seen.back().first, 0.9);
  for (const auto& [share, kernel] : seen) {
    if (share != 0.5) EXPECT_EQ(kernel, share < 0.5 ? "coc" : "tiltshift") << share;
  }
}

}  // namespace
}  // namespace defray::test::validation_test
