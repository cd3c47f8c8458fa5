// Vignetting by the lens rim: how much is left, and on which side.
#include "lens/cats_eye.h"

#include <cmath>
#include <numbers>

#include "lens/aperture_mask.h"
#include "support.h"

namespace defray::test::cats_eye_test {
namespace {

TEST(CatsEye, LeavesTheLensBetweenTwoCircles) {
  const ApertureMask circle = rasterise({});
  constexpr std::int32_t step = 64, radius = 1 << 16;  // 4 x 4 points a texel
  for (const double strength : {0.25, 0.5, 1.0}) {
    const RimCentre rim = rim_centre(strength, 640, 360, 640, 360);
    double area = 0;
    for (std::int32_t v = step / 2 - radius; v < radius; v += step) {
      for (std::int32_t u = step / 2 - radius; u < radius; u += step) {
        if (passes_rim(rim, u, v)) area += circle.at((u + radius) / 256, (v + radius) / 256);
      }
    }
    area *= std::pow(static_cast<double>(step) / radius, 2) / 255;
    const double expected =
        2 * std::acos(strength / 2) - strength / 2 * std::sqrt(4 - strength * strength);
    // Two arcs, shorter than half a circle, from 4 x 4 points a texel or finer: rows err by half a
    // point, in at most sqrt(2) texels for each texel of the arcs' length.
    const double texels = std::numbers::sqrt2 * 2 * std::numbers::pi * ApertureMask::side / 2;
    EXPECT_NEAR(area, expected, texels / 8 * std::pow(2.0 / ApertureMask::side, 2)) << strength;
  }
}

TEST(CatsEye, IsOffByItsStrengthAtCornersAndNotAtTheCentre) {
  EXPECT_EQ(rim_centre(0.7, 50, 20, 100, 40), (RimCentre{0, 0}));
  for (const double x : {0.0, 100.0}) {
    for (const double y : {0.0, 40.0}) {
      const RimCentre rim = rim_centre(0.7, x, y, 100, 40);
      EXPECT_NEAR(std::hypot(rim[0], rim[1]), 0.7 * 65536, 1);
      EXPECT_EQ(rim[0] > 0, x == 0);
      EXPECT_EQ(rim[1] > 0, y == 0);
    }
  }
}

// x = p + r (u, v), p on the frame's right: what is left of the disc on each side of p.
TEST(CatsEye, CutsTheOuterSideBehindTheFocusAndTheInnerSideInFront) {
  const RimCentre rim = rim_centre(1, 900, 500, 1000, 1000);
  for (const double r : {10.0, -10.0}) {
    double outward = 0, inward = 0, across = 0;
    for (std::int32_t v = -65536; v <= 65536; v += 512) {
      for (std::int32_t u = -65536; u <= 65536; u += 512) {
        if (std::hypot(u, v) > 65536 || !passes_rim(rim, u, v)) continue;
        outward = std::fmax(outward, r * u / 65536);
        inward = std::fmax(inward, -r * u / 65536);
        across = std::fmax(across, std::fabs(r * v / 65536));
      }
    }
    EXPECT_NEAR(r > 0 ? inward : outward, 10, 0.1) << r;
    EXPECT_LT(r > 0 ? outward : inward, 5) << r;
    EXPECT_GT(2 * across, inward + outward) << r;
  }
}

}  // namespace
}  // namespace defray::test::cats_eye_test
