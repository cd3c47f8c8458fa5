// How far values may lie apart, and what counts: distances in ulps, rules of kernels.
#include <cfloat>
#include <cmath>
#include <random>

#include "numbers.h"
#include "support.h"
#include "validation/report.h"
#include "validation/validation.h"

namespace defray::test::verdict_test {
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
}  // namespace defray::test::verdict_test
