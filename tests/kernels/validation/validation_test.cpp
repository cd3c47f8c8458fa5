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

constexpr double u = 0x1p-24;

void expect_distance(float a, float b, std::uint32_t distance) {
  EXPECT_EQ(ulp_distance(a, b), distance) << a << " " << b;
  EXPECT_EQ(ulp_distance(b, a), distance) << a << " " << b;
}

TEST(UlpDistance, SpecialValues) {
  expect_distance(nan, nan, 0);
  expect_distance(nan, -nan, 0);
  for (const float v : {0.0f, 1.0f, -1.0f, infinite, -infinite}) {
    expect_distance(nan, v, std::numeric_limits<std::uint32_t>::max());
    expect_distance(v, v, 0);
  }
  expect_distance(-0.0f, 0.0f, 1);
  expect_distance(0.0f, FLT_TRUE_MIN, 1);
  expect_distance(-FLT_TRUE_MIN, FLT_TRUE_MIN, 3);
  expect_distance(FLT_MAX, infinite, 1);
  expect_distance(-infinite, infinite, 0xff000001u);
}

TEST(UlpDistance, CountsNeighboursAtEveryMagnitude) {
  for (int exponent = -149; exponent < 128; ++exponent) {
    for (const float mantissa : {1.0f, -1.0f, 1.999f, -1.5f}) {
      const float start = std::ldexp(mantissa, exponent);
      float there = start;
      for (std::uint32_t steps = 1; steps <= 5; ++steps) {
        there = std::nextafter(there, std::copysign(infinite, start));
        expect_distance(start, there, steps);
        if (std::isinf(there)) break;
      }
    }
  }
}

TEST(UlpDistance, AddsUpAlongTheLine) {
  std::mt19937 random(3);
  for (int i = 0; i < 10000; ++i) {
    std::array<float, 3> v{};
    for (float& x : v) {
      x = std::ldexp(static_cast<float>(random()) * (random() % 2 ? 1.0f : -1.0f),
                     static_cast<int>(random() % 240) - 170);
    }
    std::sort(v.begin(), v.end());
    expect_distance(v[0], v[2], ulp_distance(v[0], v[1]) + ulp_distance(v[1], v[2]));
  }
}

TEST(UlpBins, NamesSayWhatTheBinsHold) {
  std::uint64_t next = 0;
  for (std::size_t bin = 0; bin < ulp_bins; ++bin) {
    const std::string name = ulp_bin_name(bin);
    const std::uint64_t first = std::stoull(name), dash = name.find('-');
    const std::uint64_t last =
        dash == std::string::npos ? first : std::stoull(name.substr(dash + 1));
    EXPECT_EQ(first, next) << name;
    next = last + 1;
    EXPECT_EQ(ulp_bin(static_cast<std::uint32_t>(first)), bin) << name;
    EXPECT_EQ(ulp_bin(static_cast<std::uint32_t>(std::min<std::uint64_t>(last, UINT32_MAX))), bin);
  }
  EXPECT_GT(next, UINT32_MAX);
}

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
       {Row{"coc", 1, 0}, Row{"fill", 1, 1 + colour}, Row{"gather_aware", 0, colour},
        Row{"gather_literal", 0, colour}, Row{"highlights", 0, 2}, Row{"highlights_add", 0, colour},
        Row{"linear_psf", 0, colour}, Row{"mixed", 1, 0}, Row{"patterns_match", 0, colour},
        Row{"rdb_gather", 1, colour}, Row{"rdb_merge", 1, colour}, Row{"repair", 1, 0},
        Row{"soften", 0, 2 * colour}, Row{"split", 2 * 3, 2 * colour}, Row{"tiltshift", 1, 0}}) {
    const Compared compared(row.kernel);
    EXPECT_EQ(compared.integers, 13 * 7 * row.integers) << row.kernel;
    EXPECT_EQ(compared.floats, 13 * 7 * row.floats) << row.kernel;
  }
  const Compared pad("rdb_pad");  // key, sending and coverage
  EXPECT_EQ(pad.integers * colour, pad.floats * 3);
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
  for (const char* kernel : {"mixed", "linear_psf", "rdb_merge", "rdb_nearest", "rdb_scatter",
                             "rdb_scatter_two_pass", "repair", "soften", "split"}) {
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

/// A rule alone, for values made by hand.
KernelCheck rule() { return {"", "", nullptr, nullptr, nullptr}; }

double twelve_roundings(const Case&) { return 12; }

Input with_largest(float largest) {
  Input in;
  in.channels = {{0.0f, -largest}, {0.0f, 0.0f}};
  return in;
}

Verdict strictly(const Outcome& kernel, const Outcome& twin) {
  return compare(rule(), Case(), with_largest(1), kernel, twin, true, true);
}

TEST(Verdict, CountsValuesDifferencesAndDistances) {
  const float near_one = std::nextafter(1.0f, 2.0f);
  const Outcome twin{{}, {{1, 1, 0, nan}, {1, 2, 3, infinite}}};
  const Outcome kernel{{}, {{1, near_one, -0.0f, nan}, {1, 2, nan, infinite}}};
  const Verdict v = strictly(kernel, twin);
  EXPECT_EQ(v.compared, 8u);
  EXPECT_EQ(v.differing, 3u);
  EXPECT_EQ(v.wrong, 3u);
  EXPECT_EQ(v.ulp_histogram[0], 5u);
  EXPECT_EQ(v.ulp_histogram[1], 2u);
  EXPECT_EQ(v.ulp_histogram[ulp_bins - 1], 1u);
  EXPECT_EQ(v.worst, 4294967295.0);
  EXPECT_EQ(v.worst_at, 6u);
  EXPECT_TRUE(v.has_floats());
  EXPECT_EQ(strictly(twin, twin).differing, 0u);
}

TEST(Verdict, WholeNumbersMustBeEqualUnlessTheirRuleIsExactArithmetic) {
  const Outcome twin{{5, -5, 1000000000000}, {}}, kernel{{5, -8, 1000000000001}, {}};
  const Verdict v = strictly(kernel, twin);
  EXPECT_EQ(v.compared, 3u);
  EXPECT_EQ(v.differing, 2u);
  EXPECT_EQ(v.wrong, 2u);
  EXPECT_EQ(v.worst, 3);
  EXPECT_EQ(v.worst_at, 1u);
  EXPECT_FALSE(v.has_floats());
  KernelCheck exact = rule();
  exact.exact = [](const Case&, const Input&) { return Exact{}; };
  EXPECT_EQ(compare(exact, Case(), {}, kernel, twin, true, true).wrong, 0u);
  // Beside floats the bound is theirs.
  const Outcome with_floats{twin.integers, {{1}}}, off{kernel.integers, {{1}}};
  EXPECT_EQ(compare(exact, Case(), with_largest(1), off, with_floats, true, true).wrong, 2u);
}

TEST(Verdict, FlushedDenormalsCountOnlyWhereTheDeviceKeepsThem) {
  const Outcome twin{{}, {{1e-40f, 1}}}, kernel{{}, {{0, 1}}};
  const auto wrong = [&](const Outcome& values, bool keeps) {
    return compare(rule(), Case(), with_largest(1), values, twin, keeps, true).wrong;
  };
  EXPECT_EQ(wrong(kernel, true), 1u);
  EXPECT_EQ(wrong(kernel, false), 0u);
  EXPECT_EQ(wrong({{}, {{1e-30f, 1}}}, false), 1u);
}

TEST(Verdict, UnroundedDivisionsHaveTheSlackOfTheirRule) {
  KernelCheck loose = rule();
  loose.loose_roundings = twelve_roundings;
  const auto wrong = [&](const KernelCheck& check, double roundings, bool rounds, float largest) {
    const Outcome twin{{}, {{0.5f, largest}}};
    const Outcome kernel{{}, {{static_cast<float>(0.5 + roundings * largest * u), largest}}};
    return compare(check, Case(), with_largest(largest), kernel, twin, true, rounds).wrong;
  };
  for (const float largest : {1.0f, 64.0f}) {
    EXPECT_EQ(wrong(loose, 12, false, largest), 0u);
    EXPECT_EQ(wrong(loose, 13, false, largest), 1u);
    EXPECT_EQ(wrong(loose, 12, true, largest), 1u);
    EXPECT_EQ(wrong(rule(), 12, false, largest), 1u);
  }
  // An overflow on one side alone.
  const Outcome twin{{}, {{FLT_MAX, 0}}}, kernel{{}, {{infinite, 0}}};
  EXPECT_EQ(compare(loose, Case(), with_largest(1), kernel, twin, true, false).wrong, 1u);
  EXPECT_EQ(compare(loose, Case(), with_largest(FLT_MAX), kernel, twin, true, false).wrong, 0u);
}

}  // namespace
}  // namespace defray::test::validation_test
