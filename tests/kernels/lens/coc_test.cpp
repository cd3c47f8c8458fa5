// Kernel coc and its twin against the thin lens.
#include <cmath>
#include <limits>
#include <random>

#include "faults/fault.h"
#include "numbers.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::coc_test {
namespace {

Lens lens_of(double focus, double fstop = 2.8) {
  Lens lens;
  lens.aperture_diameter_mm = lens.focal_length_mm / fstop;
  lens.focus_distance_units = focus;
  return lens;
}

std::vector<Lens> lenses() {
  std::vector<Lens> all;
  for (const double focus : {0.0500001, 0.1, 1.0 / 3, 3.0, 12.0, 1e4, 1e9, 1e30, HUGE_VAL}) {
    for (const double fstop : {0.1, 2.8, 1e6}) {
      all.push_back(lens_of(focus, fstop));
      all.push_back(lens_of(focus, fstop));
      all.back().model = LensModel::breathing;
    }
  }
  return all;
}

/// Depths over all magnitudes, those around the focus dense, the special ones among them.
Plane depths_for(const Lens& lens) {
  Plane depths{infinite, 1e10f, 65504.0f, 0.05f, 1e-6f, 1e-38f, 1e-45f, 1.0f, 3.4e38f};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-20, 40), nearby(-1e-3, 1e-3);
  for (int i = 0; i < 20000; ++i) depths.push_back(static_cast<float>(std::exp2(exponent(random))));
  const float focus = static_cast<float>(lens.focus_distance_units);
  if (!std::isinf(focus)) {
    float up = focus, down = focus;
    for (int i = 0; i < 100; ++i) {
      depths.insert(depths.end(), {up, down});
      up = std::nextafter(up, infinite);
      down = std::nextafter(down, 0.0f);
    }
    for (int i = 0; i < 2000; ++i) depths.push_back(focus * static_cast<float>(1 + nearby(random)));
  }
  return depths;
}

TEST(Coc, KernelEqualsTwinWithinHalfAQuantumAndFourUlp) {
  for (const Lens& lens : lenses()) {
    const Plane depth = depths_for(lens);
    const auto kernel = device().coc(lens, 1920, depth);
    const auto twin = twins().coc(lens, 1920, depth);
    ASSERT_EQ(kernel.size(), twin.size());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      // Three float operations and a rounded constant: under 4 ulp (2^-22) of the radius; where
      // that crosses a rounding boundary the quantised radii are one apart.
      const double bound = 1 + std::fabs(twin[i]) * 0x1p-22;
      ASSERT_LE(std::fabs(double(kernel[i]) - twin[i]), bound)
          << "depth " << depth[i] << ", focus " << lens.focus_distance_units << ", aperture "
          << lens.aperture_diameter_mm << " mm";
    }
  }
}

TEST(Coc, QuantisationErrorIsHalfAQuantum) {
  const Lens lens = lens_of(3);
  const Plane depth = depths_for(lens);
  const auto quanta = twins().coc(lens, 1920, depth);
  double worst = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double exact = reference::coc_px(lens, 1920, depth[i]);
    if (std::fabs(exact) < 4194304) worst = std::fmax(worst, std::fabs(quanta[i] / 256.0 - exact));
  }
  EXPECT_LE(worst, 1.0 / 512);
  EXPECT_GT(worst, 1.0 / 600);  // the bound is met, not avoided
}

TEST(Coc, KeepsItsDigitsNearFocus) {
  // 1 - z0/z in float loses up to 2 % at a relative distance of 1e-6; (z - z0)/z does not. A
  // long lens makes the difference visible above the quantum.
  Lens lens = lens_of(1.0 / 3, 0.1);
  lens.focal_length_mm = 300;
  lens.aperture_diameter_mm = 1e7;
  float z = static_cast<float>(1.0 / 3);
  for (int i = 0; i < 200; ++i) z = std::nextafter(z, infinite);
  const double exact = reference::coc_px(lens, 16384, z) * 256;
  const double kernel = device().coc(lens, 16384, {z}).front();
  ASSERT_GT(std::fabs(exact), 1e4);
  EXPECT_NEAR(kernel, exact, 1 + std::fabs(exact) * 0x1p-22);
}

TEST(Coc, SignsAndLimits) {
  const Lens lens = lens_of(3);
  const double k = background_coc_px(lens, 1920);
  // K = A F / (2 z0), with F = 1920 * 50 / 36 px and A = 50 / 2.8 mm.
  EXPECT_NEAR(k, 0.5 * (0.05 / 2.8) * (1920 * 50.0 / 36) / 3, 1e-12);
  EXPECT_EQ(reference::coc_px(lens, 1920, 3), 0);
  EXPECT_LT(reference::coc_px(lens, 1920, 2), 0);
  EXPECT_GT(reference::coc_px(lens, 1920, 4), 0);
  EXPECT_DOUBLE_EQ(reference::coc_px(lens, 1920, INFINITY), k);
  EXPECT_DOUBLE_EQ(reference::coc_px(lens, 1920, 1.5), -k);  // half the focus distance
}

TEST(Coc, EqualsPotmesilsFormula) {
  // Potmesil & Chakravarty 1981, eq. 4-5: image distances V = F U / (U - F); the CoC diameter on
  // the image plane is |V_u - V_p| F / (n V_u). Their sensor sits at V_p: the breathing model.
  Lens lens = lens_of(2.5, 4);
  lens.model = LensModel::breathing;
  const double f = 0.05, n = 4, p = 2.5;
  for (const double u : {0.06, 0.5, 2.0, 2.5, 3.0, 100.0}) {
    const double v_u = f * u / (u - f), v_p = f * p / (p - f);
    const double diameter_m = std::fabs(v_u - v_p) * f / (n * v_u);
    const double radius_px = 0.5 * diameter_m * 1920 / 0.036;
    EXPECT_NEAR(std::fabs(reference::coc_px(lens, 1920, u)), radius_px, 1e-9 * (1 + radius_px));
  }
}

TEST(Coc, DepthInsideTheFocalLengthFollowsTheSameFormula) {
  const Lens lens = lens_of(3);
  const auto coc = device().coc(lens, 1920, {0.04f, 0.05f, 0.06f});
  const auto twin = twins().coc(lens, 1920, {0.04f, 0.05f, 0.06f});
  EXPECT_LT(coc[0], coc[1]);
  EXPECT_LT(coc[1], coc[2]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(coc[i], twin[i], 1);
}

TEST(Coc, FocusAtInfinityLeavesTheBackgroundSharp) {
  const auto coc = device().coc(lens_of(HUGE_VAL), 1920, {infinite, 1.0f, 10.0f});
  EXPECT_EQ(coc[0], 0);
  EXPECT_NEAR(coc[1] / 256.0, -0.5 * (0.05 / 2.8) * (1920 * 50.0 / 36), 0.002);
  EXPECT_NEAR(coc[2] / 256.0, -0.05 * (0.05 / 2.8) * (1920 * 50.0 / 36), 0.002);
}

TEST(Coc, ClosedApertureGivesZeroEverywhere) {
  for (const double focus : {3.0, HUGE_VAL}) {
    Lens lens = lens_of(focus);
    lens.aperture_diameter_mm = 0;
    for (const auto q : device().coc(lens, 1920, depths_for(lens))) ASSERT_EQ(q, 0);
  }
}

TEST(Coc, LimitIsAppliedBySign) {
  Lens lens = lens_of(3);
  lens.max_coc_px = 1.5;
  const auto coc = device().coc(lens, 1920, {0.1f, 3.0f, infinite});
  EXPECT_EQ(coc, (std::vector<std::int32_t>{-384, 0, 384}));
}

TEST(Lens, RefusesWhatNoLensHas) {
  const auto with = [](auto change) {
    return [change] {
      Lens lens = lens_of(3);
      change(lens);
      validate(lens);
    };
  };
  expect_error(ErrorKind::usage, {"focal length", "0"},
               with([](Lens& l) { l.focal_length_mm = 0; }));
  expect_error(ErrorKind::usage, {"focal length", "nan"},
               with([](Lens& l) { l.focal_length_mm = NAN; }));
  expect_error(ErrorKind::usage, {"sensor width"}, with([](Lens& l) { l.sensor_width_mm = -36; }));
  expect_error(ErrorKind::usage, {"aperture", "-1"},
               with([](Lens& l) { l.aperture_diameter_mm = -1; }));
  expect_error(ErrorKind::usage, {"focus distance"},
               with([](Lens& l) { l.focus_distance_units = 0; }));
  expect_error(ErrorKind::usage, {"inside the focal length", "metres_per_unit"},
               with([](Lens& l) { l.focus_distance_units = 0.05; }));
}

const FaultRows faults{
    {"coc", "sign of the CoC", {"(z - p.focus_hi_units)", "(p.focus_hi_units - z)"}},
    {"coc", "focus distance cut to a float", {") - p.focus_lo_units", ")"}},
    {"coc",
     "background blurred with focus at infinity",
     {"? 0.0f : p.scale_quanta", "? p.infinite_focus_scale : p.scale_quanta"}},
    {"coc",
     "background takes the near sign",
     {"? 0.0f : p.scale_quanta", "? 0.0f : -p.scale_quanta"}},
    {"coc",
     "limit without the near side",
     {"clamp(radius, -p.limit_quanta, p.limit_quanta)",
      "clamp(radius, -0.5f * p.limit_quanta, p.limit_quanta)"}},
    {"coc", "rounded towards zero", {"convert_int_rte(clamp", "convert_int_rtz(clamp"}},
    {"coc", "last pixel dropped", {"if (i >= p.pixel_count)", "if (i + 1 >= p.pixel_count)"}},
};

TEST(Coc, SameBitsWhereNoBufferHoldsAPlane) {
  const Lens lens = lens_of(3);
  const Plane depths = depths_for(lens);
  DeviceInfo info = device_under_test();
  info.max_buffer_bytes = 1000 * sizeof(float);
  Session small(info);
  EXPECT_EQ(DeviceBackend(small).coc(lens, 1920, depths), device().coc(lens, 1920, depths));
}

}  // namespace
}  // namespace defray::test::coc_test
