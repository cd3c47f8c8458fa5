// The aperture's shape against closed forms, its vignetting, and what is refused.
#include "aperture.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "aperture_mask.h"
#include "cats_eye.h"
#include "support.h"

namespace defray::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int side = ApertureMask::side;
constexpr double texels_in_radius = side / 2.0;

Aperture blades(int count, double curvature = 0, double rotation_deg = 0, double squeeze = 1) {
  return {count, curvature, rotation_deg, squeeze, "", 0};
}

/// In units of the squared aperture radius.
double area_of(const ApertureMask& mask) {
  double sum = 0;
  for (const std::uint8_t value : mask.coverage) sum += value / 255.0;
  return sum / (texels_in_radius * texels_in_radius);
}

/// What texels may be off by, for an edge of this length with so many corners: a texel's rows of 8
/// points err by half a point each, its 8 bits by half a step. A curve meets at most sqrt(2) texels
/// in a texel's length, and in one more at each end of its parts; corners count twice.
double area_tolerance(double edge_length, int corners) {
  const double texels = std::numbers::sqrt2 * edge_length * texels_in_radius + 4 * (corners + 1);
  return texels * (1.0 / 16 + 1.0 / 510) / (texels_in_radius * texels_in_radius);
}

TEST(Aperture, CirclesAndOvalsHaveTheirArea) {
  for (const double squeeze : {0.125, 0.5, 1.0, 1.33, 2.0, 8.0}) {
    EXPECT_NEAR(area_of(rasterise(blades(0, 0, 0, squeeze))), pi * std::fmin(squeeze, 1 / squeeze),
                area_tolerance(2 * pi, 0))
        << squeeze;
  }
}

/// A polygon with corners on the unit circle, and the segments between its sides and the arcs.
double area_of_blades(int count, double curvature) {
  const double half_chord = std::sin(pi / count);
  const double sagitta = std::fabs(curvature) * (1 - std::cos(pi / count));
  const double polygon = count / 2.0 * std::sin(2 * pi / count);
  if (curvature == 0) return polygon;
  const double radius = (half_chord * half_chord + sagitta * sagitta) / (2 * sagitta);
  const double half_angle = std::asin(half_chord / radius);
  const double segment =
      radius * radius * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  return polygon + std::copysign(count * segment, curvature);
}

TEST(Aperture, BladesHaveTheirArea) {
  for (const int count : {3, 4, 5, 6, 9, 32}) {
    for (const double curvature : {-1.0, -0.3, 0.0, 1e-9, 0.4, 1.0}) {
      if (count == 3 && curvature < 0) continue;
      for (const double rotation : {0.0, 17.0, -400.0}) {
        EXPECT_NEAR(area_of(rasterise(blades(count, curvature, rotation))),
                    area_of_blades(count, curvature), area_tolerance(2 * pi, count))
            << count << " blades, " << curvature << ", " << rotation << " degrees";
      }
    }
  }
}

/// Points on an edge may fall on either side, by rounding: one of 64 in a texel.
void expect_alike(const ApertureMask& a, const ApertureMask& b) {
  for (std::size_t i = 0; i < a.coverage.size(); ++i) {
    ASSERT_NEAR(a.coverage[i], b.coverage[i], 4) << i % side << "," << i / side;
  }
}

TEST(Aperture, RoundBladesAreACircle) {
  const ApertureMask circle = rasterise({});
  for (const int count : {3, 6, 31}) expect_alike(rasterise(blades(count, 1, 5)), circle);
}

TEST(Aperture, TurnsCounterClockwiseFromABladeOnTheRight) {
  const ApertureMask still = rasterise(blades(3)), turned = rasterise(blades(3, 0, 90));
  EXPECT_EQ(still.at(side / 2 + side / 8, side / 2), 255);  // the side at u = 1/2 ...
  EXPECT_EQ(still.at(3 * side / 4 + 1, side / 2), 0);
  EXPECT_GT(still.at(1, side / 2), 0);  // ... and the corner at u = -1
  ApertureMask expected = still;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      // Right goes up: what is at (-v, u) comes to (u, v).
      expected.coverage[static_cast<std::size_t>(row) * side + column] =
          still.at(side - 1 - row, column);
    }
  }
  expect_alike(turned, expected);
  expect_alike(rasterise(blades(7, 0.2, 13)), rasterise(blades(7, 0.2, 13 + 360.0 / 7)));
}

TEST(Aperture, SqueezeTwoIsTwiceAsTallAsWide) {
  const ApertureMask tall = rasterise(blades(0, 0, 0, 2)), wide = rasterise(blades(0, 0, 0, 0.5));
  for (int i = 0; i < side; ++i) {
    const int from_middle = std::abs(2 * i + 1 - side);
    EXPECT_EQ(tall.at(i, side / 2) > 0, from_middle < side / 2) << i;
    EXPECT_EQ(wide.at(side / 2, i) > 0, from_middle < side / 2) << i;
    EXPECT_GT(tall.at(side / 2, i), 0) << i;
    EXPECT_GT(wide.at(i, side / 2), 0) << i;
  }
}

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
    // The rim's arc, shorter than half a circle, from 4 x 4 points: rows err by half a point.
    const double of_rim = std::numbers::sqrt2 * pi * texels_in_radius / 8;
    EXPECT_NEAR(area, expected,
                area_tolerance(pi, 2) + of_rim / (texels_in_radius * texels_in_radius))
        << strength;
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

TEST(Aperture, RefusesWhatIsNotAllowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto refused = [](const Aperture& a, const std::vector<std::string>& words) {
    expect_error(2, words, [&] { validate(a); });
    expect_error(2, words, [&] { rasterise(a); });
  };
  for (const int count : {-1, 1, 2, 33}) {
    refused(blades(count), {"--blades is " + std::to_string(count), "3 to 32"});
  }
  refused(blades(5, 1.5), {"--blade-curvature is 1.5", "-1 to 1"});
  refused(blades(5, nan), {"--blade-curvature is nan"});
  refused(blades(3, -0.5), {"--blade-curvature is -0.5", "4 or more"});
  refused(blades(5, 0, inf), {"--blade-rotation is inf", "finite"});
  refused(blades(5, 0, 0, 0), {"--squeeze is 0", "0.125 to 8"});
  refused(blades(0, 0, 0, nan), {"--squeeze is nan"});
  refused({0, 0, 0, 1, "", 1.25}, {"--cats-eye is 1.25", "0 to 1"});
  refused({6, 0, 0, 1, "a.png", 0}, {"--aperture-image", "--blades"});
  refused(blades(0, 0.5), {"--blade-curvature", "--blades"});
  refused({0, 0, 30, 1, "a.png", 0}, {"--blade-rotation", "--blades"});
}

}  // namespace
}  // namespace defray::test
