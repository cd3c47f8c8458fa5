// Radii as which rays of small CoCs land: what is left of fine detail, by another way.
#include "lens/landing_radii.h"

#include <cmath>
#include <numbers>

#include "lens/lens_grid.h"
#include "support.h"

namespace defray::test::landing_radii_test {
namespace {

LensPoints with_radii(LensPoints lens) {
  lens.landing_radii = landing_radii(lens);
  return lens;
}

LensPoints round_lens(int points) { return with_radii(make_lens_points(Aperture{}, points)); }

/// What lens points leave of cosines of 0.4 cycles a pixel, along x and y: where `radius_px` sends
/// them, rounded to pixels or not.
double left_of_cosines(const LensPoints& lens, double radius_px, bool is_rounded) {
  double sum = 0;
  for (const auto& point : lens.points) {
    for (const double u : {point[0] / 65536.0, point[1] / 65536.0}) {
      const double at = is_rounded ? std::ceil(radius_px * u - 0.5) : radius_px * u;
      sum += std::cos(2 * std::numbers::pi * 0.4 * at);
    }
  }
  return sum / (2.0 * static_cast<double>(lens.points.size()));
}

TEST(LandingRadii, LeaveOfDetailWhatTheLensDoes) {
  for (const int points : {37, 137, 855}) {
    const LensPoints lens = round_lens(points);
    for (int r = 0; r < 256; ++r) {
      const double wanted = left_of_cosines(lens, r / 256.0, false);
      const auto apart = [&](int as) {
        return std::fabs(left_of_cosines(lens, as / 256.0, true) - wanted);
      };
      const int as = lens.landing_radii[static_cast<std::size_t>(r)];
      for (int other = 0; other <= 256; other += 8) {
        EXPECT_LE(apart(as), apart(other) + 1e-4) << other << " for " << r << " of " << points;
      }
    }
  }
}

TEST(LandingRadii, AreThoseOfTheDiscWhereThereAreManyPoints) {
  const LensPoints lens = round_lens(4096);
  for (const double px : {0.2, 0.35, 0.5, 0.7, 0.9}) {
    const double x = 2 * std::numbers::pi * 0.4 * px;
    const double as = lens.landing_radii[static_cast<std::size_t>(256 * px)] / 256.0;
    EXPECT_NEAR(left_of_cosines(lens, as, true), 2 * std::cyl_bessel_j(1, x) / x, 0.01) << px;
  }
  EXPECT_NEAR(left_of_cosines(lens, 0.49, true), 1, 1e-9) << "rounded as they are";
}

TEST(LandingRadii, NeverFallAndStayBelowAPixel) {
  for (const int points : {1, 2, 5, 37, 137}) {
    const LensPoints lens = round_lens(points);
    ASSERT_EQ(lens.landing_radii.size(), 256U);
    EXPECT_EQ(lens.landing_radii[0], 0);
    for (std::size_t r = 1; r < 256; ++r) {
      EXPECT_GE(lens.landing_radii[r], lens.landing_radii[r - 1]);
      EXPECT_LE(lens.landing_radii[r], 256);
    }
  }
}

TEST(LandingRadii, AreTheirOwnFromAPixelOnAndWithoutATable) {
  const LensPoints lens = round_lens(137), plain = make_lens_points(Aperture{}, 137);
  for (const std::int64_t r : {256, 300, 1 << 30}) {
    EXPECT_EQ(landing_radius(lens, r), r);
    EXPECT_EQ(landing_radius(lens, -r), -r);
    EXPECT_EQ(first_landing_as(lens, r), r);
    EXPECT_EQ(first_landing_as(lens, -r), -r);
  }
  EXPECT_EQ(landing_radius(plain, 100), 100);
  EXPECT_EQ(first_landing_as(plain, -100), -100);
  EXPECT_EQ(landing_radius(lens, -200), -lens.landing_radii[200]);
}

TEST(LandingRadii, FirstOfAll) {
  // Of four lens points, half way to the rim, small radii land as one of 1 px.
  const LensPoints lenses[] = {round_lens(37), with_radii(make_lens_grid(2, false))};
  EXPECT_EQ(lenses[1].landing_radii.back(), 256);
  for (const LensPoints& lens : lenses) {
    for (std::int64_t landing = -300; landing <= 300; ++landing) {
      const std::int64_t first = first_landing_as(lens, landing);
      EXPECT_GE(landing_radius(lens, first), landing);
      EXPECT_LT(landing_radius(lens, first - 1), landing) << landing;
    }
  }
}

TEST(LandingRadii, OfALensInItsMiddleAreNone) {
  const LensPoints middle = with_radii(make_lens_grid(1, false));
  for (const std::int32_t radius : middle.landing_radii) EXPECT_EQ(radius, 0);
}

}  // namespace
}  // namespace defray::test::landing_radii_test
