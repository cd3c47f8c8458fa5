// Vignetting by the lens rim: how much is left, and on which side.
#include "lens/cats_eye.h"

#include <cmath>
#include <numbers>

#include "chain/plan/ray_plan.h"
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

TEST(CatsEye, RaysHaveTheRimOfTheirPixelsCentre) {
  Frame f;
  f.width = 9;
  f.height = 6;
  f.margin = 1;
  f.origin_x = f.origin_y = -1;
  for (const bool has_display : {false, true}) {
    if (has_display) f.display_width = 20, f.display_height = 12, f.origin_x = 4, f.origin_y = 3;
    RayPlan plan;
    place_rays(f, 0.5, plan);
    const int width = has_display ? 20 : 7, height = has_display ? 12 : 4;
    ASSERT_EQ(plan.rim_x.size(), 9u);
    ASSERT_EQ(plan.rim_y.size(), 6u);
    for (int x = 0; x < 9; ++x) {
      EXPECT_EQ(plan.rim_x[size(x)], rim_centre(0.5, x + f.origin_x + 0.5, 1, width, height)[0]);
    }
    for (int y = 0; y < 6; ++y) {
      EXPECT_EQ(plan.rim_y[size(y)], rim_centre(0.5, 1, y + f.origin_y + 0.5, width, height)[1]);
    }
  }
  RayPlan none;
  place_rays(f, 0, none);
  EXPECT_TRUE(none.rim_x.empty() && none.rim_y.empty());
}

}  // namespace
}  // namespace defray::test::cats_eye_test
