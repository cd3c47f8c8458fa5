// Means over the most lens points there are, of colours as unequal as they come, against exact
// ones.
#include <cmath>
#include <cstdio>

#include "lens/lens_grid.h"
#include "rdb/rdb.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::extreme_sums_test {
namespace {

/// 1e30 beside 1e-30, and everything between.
Plane unequal_colours(Size size, std::uint32_t seed) {
  Plane plane = random_plane(size, seed);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i] = std::fabs(plane[i]) * (i % 7 == 3 ? 1e30f : i % 7 == 5 ? 1.0f : 1e-30f);
  }
  return plane;
}

TEST(ExtremeSums, MeansOfLightAreWithinARoundingACell) {
  // Light has one sign: no partial sum is larger than the whole, and each of the n - 1 additions is
  // off by u = 2^-24 of it at most. The quotient adds u, or 5 u where division is 2.5 ulp off.
  const double division = session().info().rounds_divisions ? 1 : 5;
  const Size size = is_slow_device() ? Size{7, 5} : Size{17, 11};
  double worst = 0;
  for (const bool jitter : {false, true}) {
    RdbSettings settings;
    settings.cells_per_side = is_slow_device() ? 12 : 64;
    settings.jitter = jitter;
    const double cells =
        static_cast<double>(make_lens_grid(settings.cells_per_side, jitter).points.size());
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
      const auto coc = random_coc(size, 5, seed);
      const Plane depth = random_depth(size, seed + 10), colour = unequal_colours(size, seed + 20);
      const auto kernel =
          device().rays({size.width, size.height, coc, depth, {colour}}, plan_rays(settings)).means;
      const auto twin =
          twins().rays({size.width, size.height, coc, depth, {colour}}, plan_rays(settings)).means;
      EXPECT_EQ(hash_of(kernel), hash_of(twin));
      const auto exact = reference::exact_rays({size.width, size.height, coc, depth, {colour}},
                                               plan_rays(settings))[0];
      for (std::size_t i = 0; i < exact.size(); ++i) {
        const double error = std::fabs(kernel[0][i] - exact[i]) / exact[i];
        ASSERT_LE(error, (cells + division) * 0x1p-24) << "pixel " << i << ", seed " << seed;
        worst = std::fmax(worst, error);
      }
    }
  }
  std::printf("rdb: means of unequal light %.3g off at worst, relatively\n", worst);
  RecordProperty("worst_relative", std::to_string(worst));
  EXPECT_GT(worst, 0x1p-24);
}

}  // namespace
}  // namespace defray::test::extreme_sums_test
