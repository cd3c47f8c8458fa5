// How far kernels may lie from exact arithmetic, and from their twins where a device does not round
// divisions: as many roundings as the derivations beside the checks count, neither more nor less.
#include <cmath>

#include "lens/lens_points.h"
#include "support.h"
#include "validation/kernel_checks.h"
#include "validation/validation.h"

namespace defray::test::validation_bounds_test {
namespace {

using namespace defray::validation;

double exact_roundings(const char* kernel, const std::string& text) {
  const Case c = parse_case(text);
  return find_check(kernel).exact(c, make_input(c)).roundings;
}

double loose_roundings(const char* kernel, const std::string& text) {
  return find_check(kernel).loose_roundings(parse_case(text));
}

TEST(Bounds, OfExactSumsAreThoseOfTheirTerms) {
  EXPECT_EQ(exact_roundings("coc", "8x8,coc=3"), 4 * 2);  // 4 ulp
  // Cells: of an n x n grid those whose centres lie in the disc; n additions and a division.
  for (const auto& [grid, cells] : {std::pair{"1", 1}, {"3", 9}, {"5", 21}}) {
    for (const char* kernel : {"rdb_gather", "rdb_merge"}) {
      const std::string text = "8x8,coc=3,cells=" + std::string(grid);
      EXPECT_EQ(exact_roundings(kernel, text), cells + 5) << kernel << grid;
    }
  }
  // 7 x 7 pixels: a root and a difference of up to 4, quotient, product, and 49 additions.
  EXPECT_EQ(exact_roundings("linear_psf", "8x8,coc=3"), 49 * (4 + 4 + 1 + 1 + 1 + 49));
}

TEST(Bounds, OfUnroundedDivisionsAreThoseOfTheirQuotientsAndRoots) {
  // 2 L, 5 u off, and the sum after it.
  for (const char* kernel : {"gather_literal", "rdb_gather", "rdb_merge"}) {
    EXPECT_EQ(loose_roundings(kernel, "8x8,coc=3,cells=3,samples=5"), 2 * 5 + 2) << kernel;
  }
  EXPECT_EQ(loose_roundings("linear_psf", "8x8,coc=3"), 49 * 2 * 6 * 4);
  // Of 16 samples, each for 1/16 of the square around a disc of 8 px: 2 L twice, a root of up to 8,
  // a quotient.
  EXPECT_EQ(loose_roundings("gather_aware", "8x8,coc=8,samples=16"), 4 * 16 * (6 * 8 + 12) * 16);
  // Of discs within as many pixels as samples each stands for itself.
  EXPECT_EQ(loose_roundings("gather_aware", "8x8,coc=1,samples=16"), 4 * 16 * (6 + 12));
  EXPECT_EQ(loose_roundings("gather_aware", "8x8,coc=70000,samples=16"),
            loose_roundings("gather_aware", "8x8,coc=65536,samples=16"));
  EXPECT_GT(loose_roundings("gather_aware", "8x8,coc=65536,samples=16"),
            loose_roundings("gather_aware", "8x8,coc=65535,samples=16"));
  // A weight: the sixth powers of two quotients, 5 u off each, and its products; three times.
  EXPECT_EQ(loose_roundings("patterns_match", "8x8"), 3 * 2 * (6 * 5 + 6 * 5 + 12) + 20);
}

TEST(Bounds, OfFlushedDenormalsAreFourForEachTermAnd64More) {
  const auto wrong = [](double denormals) {
    const Outcome twin{{}, {{0, 1, 2}}};
    const Outcome kernel{{}, {{static_cast<float>(std::ldexp(denormals, -126)), 1, 2}}};
    return compare({"", "", nullptr, nullptr}, Case(), {}, kernel, twin, false, true).wrong;
  };
  EXPECT_EQ(wrong(4 * (3 + 64)), 0u);
  EXPECT_EQ(wrong(-4 * (3 + 64)), 0u);
  EXPECT_EQ(wrong(4 * (3 + 64) + 1), 1u);
}

}  // namespace
}  // namespace defray::test::validation_bounds_test
