// Depths and lenses at their limits: each has a CoC, the same in kernel and twin.
#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::extremes_test {
namespace {

constexpr int width = 1920;
constexpr std::int32_t limit = DEFRAY_COC_LIMIT_QUANTA;

Lens lens_of(double focus, double fstop, LensModel model = LensModel::cg) {
  Lens lens;
  lens.aperture_diameter_mm = lens.focal_length_mm / fstop;
  lens.focus_distance_units = focus;
  lens.model = model;
  return lens;
}

/// A lens whose background's CoC has this radius.
Lens lens_of_background(double radius_px, double focus = 3) {
  Lens lens = lens_of(focus, 1);
  lens.aperture_diameter_mm *= radius_px / background_coc_px(lens, width);
  return lens;
}

/// Half the focal length's square over f-number and sharpness: focused there, infinity is as sharp.
double hyperfocal_units(double fstop, double sharp_diameter_mm) {
  const Lens lens;
  return (lens.focal_length_mm * lens.focal_length_mm / (fstop * sharp_diameter_mm) +
          lens.focal_length_mm) /
         1000;
}

std::vector<Lens> extreme_lenses() {
  std::vector<Lens> lenses;
  for (const double focus :
       {0.05 * (1 + 1e-6), 0.06, 3.0, hyperfocal_units(2.8, 0.03), 1e10, 1e30, double{HUGE_VAL}}) {
    for (const double fstop : {0.1, 2.8, 1e6}) {
      lenses.push_back(lens_of(focus, fstop));
      lenses.push_back(lens_of(focus, fstop, LensModel::breathing));
    }
  }
  return lenses;
}

TEST(ExtremeDepths, WhatIsNoDepthIsBackground) {
  const Plane none{infinite, nan, -nan, 0.0f, -0.0f, -denormal, -1.0f, -largest, -infinite};
  for (const Lens& lens : extreme_lenses()) {
    const auto kernel = device().coc(lens, width, none);
    const auto twin = twins().coc(lens, width, none);
    for (std::size_t i = 0; i < none.size(); ++i) {
      EXPECT_EQ(kernel[i], kernel[0]) << none[i] << ", focus " << lens.focus_distance_units;
      EXPECT_EQ(twin[i], twin[0]) << none[i] << ", focus " << lens.focus_distance_units;
      EXPECT_GE(kernel[i], 0);
    }
    EXPECT_LE(std::abs(kernel[0] - twin[0]), 1 + std::ldexp(twin[0], -22));
  }
}

TEST(ExtremeDepths, NearAndFarOnesKeepTheirSide) {
  const Plane near{denormal, 1e-38f, 1e-10f, 1e-6f};
  const Plane far{65504.0f, 1e9f, 1e10f, 1e12f, largest};
  for (const Lens& lens : extreme_lenses()) {
    const double focus = lens.focus_distance_units;
    const auto in_front = device().coc(lens, width, near);
    const auto behind = device().coc(lens, width, far);
    const auto background = device().coc(lens, width, {infinite})[0];
    EXPECT_TRUE(std::is_sorted(in_front.begin(), in_front.end())) << focus;
    EXPECT_TRUE(std::is_sorted(behind.begin(), behind.end())) << focus;
    EXPECT_EQ(in_front[0], -limit) << "a denormal depth, focus " << focus;
    EXPECT_LE(in_front[3], 0);
    EXPECT_LE(behind[4], background);
    if (focus < 65504) {
      EXPECT_GE(behind[0], 0) << focus;
    }
    const auto twin = twins().coc(lens, width, near);
    for (std::size_t i = 0; i < near.size(); ++i) {
      EXPECT_LE(std::fabs(double(in_front[i]) - twin[i]), 1 + std::fabs(twin[i]) * 0x1p-21);
    }
  }
}

TEST(ExtremeDepths, OneUlpFromFocusIsNotInFocus) {
  for (const float focus : {0.1f, 1.0f, 3.0f, 65504.0f, 1e30f}) {
    // Background CoC 2^29 px: one ulp of the depth is then 8 to 16 thousand quanta or more.
    const Lens lens = lens_of_background(0x1p29, focus);
    const float before = std::nextafter(focus, 0.0f), behind = std::nextafter(focus, infinite);
    const auto coc = device().coc(lens, width, {before, focus, behind});
    EXPECT_EQ(coc[1], 0);
    for (const int side : {0, 2}) {
      const double z = side == 0 ? before : behind;
      const double exact = 0x1p37 * ((z - focus) / z);
      EXPECT_GT(std::fabs(exact), 4000);
      EXPECT_NEAR(coc[side], exact, 0.5 + std::fabs(exact) * 0x1p-21) << focus;
    }
  }
}

TEST(ExtremeLenses, FocusedAtTheHyperfocalDistanceInfinityIsJustSharp) {
  for (const double fstop : {0.1, 2.8, 64.0}) {
    for (const double sharp_mm : {0.03, 0.5}) {
      const double focus = hyperfocal_units(fstop, sharp_mm);
      const Lens lens = lens_of(focus, fstop, LensModel::breathing);
      const double radius_px = 0.5 * sharp_mm / lens.sensor_width_mm * width;
      const auto coc = device().coc(lens, width, {infinite, static_cast<float>(focus / 2)});
      EXPECT_NEAR(coc[0], 256 * radius_px, 0.5 + 256 * radius_px * 0x1p-21);
      EXPECT_NEAR(coc[1], -256 * radius_px, 0.5 + 256 * radius_px * 0x1p-20);  // as sharp there
    }
  }
}

TEST(ExtremeLenses, ValuesOutsideTheirRangeAreRefused) {
  const auto refused = [](double Lens::*value, double bad, const std::string& words) {
    Lens lens = lens_of(3, 2.8);
    lens.*value = bad;
    expect_error(ErrorKind::usage, {words}, [&] { validate(lens); });
  };
  for (const double bad : {-1.0, 0.9e-30, 1.1e30, double{HUGE_VAL}, double{NAN}}) {
    refused(&Lens::focal_length_mm, bad, "focal length");
    refused(&Lens::sensor_width_mm, bad, "sensor width");
    refused(&Lens::metres_per_unit, bad, "scene unit");
    refused(&Lens::aperture_diameter_mm, bad, "aperture diameter");
    refused(&Lens::pixels_per_metre, bad, "pixels_per_metre");
    if (bad < 1e30 || std::isnan(bad)) refused(&Lens::focus_distance_units, bad, "focus distance");
  }
  for (const Lens& lens : extreme_lenses()) EXPECT_NO_THROW(validate(lens));
}

}  // namespace
}  // namespace defray::test::extremes_test
