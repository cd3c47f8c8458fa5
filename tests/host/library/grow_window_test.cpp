// How far data windows grow, against the CoC's formula.
#include "library/grow_window.h"

#include <cmath>
#include <limits>

#include "support.h"

namespace defray::test::grow_window_test {
namespace {

constexpr int lens_width = 480;
const Window data{40, 30, 10, 8}, display{0, 0, 480, 320};

/// 50 mm at f/1 on 36 mm.
Lens lens_at(double focus_units) {
  Lens lens;
  lens.focal_length_mm = lens.aperture_diameter_mm = 50;
  lens.focus_distance_units = focus_units;
  return lens;
}

/// On every side, of one depth.
int growth(const Lens& lens, double z) {
  const Plane alpha(80, 0.5f), depth(80, static_cast<float>(z));
  const Window grown = grown_window(data, display, &alpha, depth, lens, lens_width, Grow::full);
  EXPECT_EQ(grown.width - data.width, 2 * (data.x - grown.x));
  EXPECT_EQ(grown.height - data.height, 2 * (data.y - grown.y));
  EXPECT_EQ(data.x - grown.x, data.y - grown.y);
  return data.x - grown.x;
}

/// A F / 2 |1/z0 - 1/z|, px: F of 480 px for 36 mm.
double radius_px(double focus, double z) {
  return 0.05 * (480 * 50 / 36.0) / 2 * std::fabs(1 / focus - 1 / z);
}

TEST(GrowWindow, ByTheRadiusOfWhatItHolds) {
  for (const double z : {0.5, 1.0, 2.0, 29.0}) {
    EXPECT_EQ(growth(lens_at(3), z), std::ceil(radius_px(3, z))) << z;
  }
}

TEST(GrowWindow, WithFocusAtInfinityTheNearerTheMore) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double z : {0.5, 1.0, 2.0, 29.0}) {
    EXPECT_EQ(growth(lens_at(infinite), z), std::ceil(radius_px(infinite, z))) << z;
  }
}

TEST(GrowWindow, FromOutsideTheFrameAsFarAsTheBlurReachesIntoIt) {
  const Plane alpha(80, 0.5f), depth(80, 1.0f);  // 11.1 px
  const auto grown = [&](const Window& from) {
    return grown_window(from, display, &alpha, depth, lens_at(3), lens_width, Grow::display);
  };
  EXPECT_EQ(grown({-21, 30, 10, 8}), (Window{-21, 18, 22, 32}));
  EXPECT_EQ(grown({484, 30, 10, 8}), (Window{472, 18, 22, 32}));
  EXPECT_EQ(grown({40, 322, 10, 8}), (Window{28, 310, 34, 20}));
  // Towards a corner discs reach less far than their windows.
  EXPECT_EQ(grown({-17, -15, 10, 8}), (Window{-17, -15, 22, 20}));
  for (const Window& beyond :
       {Window{-22, 30, 10, 8}, {492, 30, 10, 8}, {40, -20, 10, 8}, {-18, -16, 10, 8}}) {
    EXPECT_EQ(grown(beyond), beyond);
  }
}

}  // namespace
}  // namespace defray::test::grow_window_test
