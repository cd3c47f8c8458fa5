// The aperture's shape against closed forms, and what is refused.
#include "lens/aperture.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "lens/aperture_mask.h"
#include "lens/iris.h"
#include "support.h"

namespace defray::test::aperture_test {
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

/// From 8 x 8 points in every texel.
template <typename IsOpen>
ApertureMask count_points(const IsOpen& is_open) {
  ApertureMask mask;
  for (int i = 0; i < side * side; ++i) {
    int open = 0;
    for (int point = 0; point < 64; ++point) {
      const double column = i % side + (point % 8 + 0.5) / 8,
                   row = i / side + (point / 8 + 0.5) / 8;
      open += is_open(column / texels_in_radius - 1, row / texels_in_radius - 1) ? 1 : 0;
    }
    mask.coverage.push_back(static_cast<std::uint8_t>(std::lround(open * 255 / 64.0)));
  }
  return mask;
}

TEST(Aperture, CountsPointsWhereverATexelIsOpenInPart) {
  expect_alike(rasterise(blades(0, 0, 0, 8)),
               count_points([](double u, double v) { return std::hypot(8 * u, v) <= 1; }));
  // Four blades of curvature -1: what four circles through neighbouring corners leave.
  expect_alike(rasterise(blades(4, -1)), count_points([](double u, double v) {
                 const double across = std::fmin(std::fabs(u), std::fabs(v));
                 const double along = std::fmax(std::fabs(u), std::fabs(v));
                 return std::hypot(u, v) <= 1 &&
                        std::hypot(along - std::numbers::sqrt2, across) >= 1;
               }));
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

TEST(Aperture, RefusesWhatIsNotAllowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto refused = [](const Aperture& a, const std::vector<std::string>& words) {
    expect_error(ErrorKind::usage, words, [&] { validate(a); });
    expect_error(ErrorKind::usage, words, [&] { rasterise(a); });
  };
  for (const int count : {-1, 1, 2, 33}) {
    refused(blades(count), {"blades is " + std::to_string(count), "3 to 32"});
  }
  refused(blades(5, 1.5), {"curvature is 1.5", "-1 to 1"});
  refused(blades(5, nan), {"curvature is nan"});
  refused(blades(3, -0.5), {"curvature is -0.5", "4 or more"});
  refused(blades(5, 0, inf), {"rotation_deg is inf", "finite"});
  refused(blades(5, 0, 0, 0), {"squeeze is 0", "0.125 to 8"});
  refused(blades(0, 0, 0, nan), {"squeeze is nan"});
  refused({0, 0, 0, 1, "", 1.25}, {"cats_eye is 1.25", "0 to 1"});
  refused({6, 0, 0, 1, "a.png", 0}, {"aperture.image", "blades"});
  refused(blades(0, 0.5), {"curvature", "blades"});
  refused({0, 0, 30, 1, "a.png", 0}, {"rotation_deg", "blades"});
}

TEST(Iris, SharesOfStraightBladesAreTriangles) {
  for (const int count : {3, 5, 8}) {
    const Iris iris(blades(count));
    const double half_blade = pi / count, start = iris.edge_at_share(0).angle;
    for (int i = 0; i <= 1000; ++i) {
      const double share = i / 1000.0 / count;  // of the first blade, from its middle on
      const double of_half = i <= 500 ? 2 * i / 1000.0 : 2 - 2 * i / 1000.0;
      const double within = std::atan(of_half * std::tan(half_blade));
      const double angle = i <= 500 ? within : 2 * half_blade - within;
      EXPECT_NEAR(iris.edge_at_share(share).angle - start, angle, 1e-6) << count << " " << i;
    }
  }
}

}  // namespace
}  // namespace defray::test::aperture_test
