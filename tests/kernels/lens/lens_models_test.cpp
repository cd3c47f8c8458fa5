// One lens: the circle of confusion of four papers, each in its own parameters, is the same.
// The mapping between them is written down here, and in the README.
//
//   here                      Potmesil 1981   Glatzel & Wilhelm    Krivanek & Zara   Shinya 1994
//   aperture diameter A       F / n           A                    F / n             2 R
//   focal length f            F               1/(1/z0 + 1/s0)      F                 f
//   focus distance z0         P               z0                   P                 1/(1/f -
//   1/z_s) depth z                   U               z1                   U                 z_o
//   image distance            V_p             s0                   V_p               z_s
//   px per metre of sensor    -               b                    W N / (R - L)     -
#include <cmath>
#include <limits>
#include <random>

#include "lens/camera.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::lens_models_test {
namespace {

/// A camera in the papers' terms, metres. Distances are along the axis.
struct Camera {
  double f, n, focus, px_per_metre;
  double image_distance() const { return f * focus / (focus - f); }
  double aperture() const { return f / n; }
};

/// Potmesil & Chakravarty: image distances V = F U / (U - F); diameter |V_u - V_p| F / (n V_u).
double potmesil_px(const Camera& c, double z) {
  const double v_u = c.f * z / (z - c.f), v_p = c.image_distance();
  return 0.5 * std::fabs(v_u - v_p) * c.f / (c.n * v_u) * c.px_per_metre;
}

/// Glatzel & Wilhelm, eq. 3: |A s0 / z0 (1 - 1/d)|, d = z1 / z0, times b.
double glatzel_px(const Camera& c, double z) {
  const double d = z / c.focus;
  return 0.5 * std::fabs(c.aperture() * c.image_distance() / c.focus * (1 - 1 / d)) *
         c.px_per_metre;
}

/// Krivanek & Zara: C = 1/2 |V_u - V_p| F / (n V_u), times W / (R - L) N / V_p: with the picture
/// plane at N, W pixels from L to R, px_per_metre on the sensor at V_p.
double krivanek_px(const Camera& c, double z) {
  const double v_u = c.f * z / (z - c.f), v_p = c.image_distance();
  const double near_plane = 0.1, width_px = 1920;
  const double width_m = width_px / c.px_per_metre * near_plane / v_p;  // R - L
  const double c_m = 0.5 * std::fabs(v_u - v_p) * c.f / (c.n * v_u);
  return c_m * (width_px / width_m) * near_plane / v_p;
}

/// Shinya, eq. 2 and 3 (M + 1 for the printed M - 1): rays through the aperture's rim, |x| = R,
/// from the image point at z_i meet the screen at (M + 1) x_i -+ R over M.
double shinya_px(const Camera& c, double z) {
  const double z_i = 1 / (1 / c.f - 1 / z), z_s = c.image_distance();
  const double m = z_i / (z_s - z_i);
  return std::fabs(c.aperture() / 2 / m) * c.px_per_metre;
}

/// The same camera as defray knows it: the textbook model, whose sensor is at the image distance.
Lens lens_of(const Camera& c) {
  Lens lens;
  lens.focal_length_mm = 1000 * c.f;
  lens.aperture_diameter_mm = 1000 * c.aperture();
  lens.focus_distance_units = c.focus;
  lens.pixels_per_metre = c.px_per_metre;
  lens.model = LensModel::breathing;
  return lens;
}

TEST(OneLens, FourPapersCirclesOfConfusionAreEqual) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  const auto log_between = [&](double a, double b) { return a * std::pow(b / a, share(random)); };
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double f = log_between(0.004, 1);
    const Camera camera{f, log_between(0.5, 64), f * log_between(1.01, 1e5), log_between(1e3, 1e6)};
    const double z = f * log_between(1.01, 1e6);
    const double expected = std::fabs(reference::coc_px(lens_of(camera), 1920, z));
    // The papers subtract image distances of the size of f: roundings are relative to the rim's
    // offset in pixels, and grow where an image goes to infinity, z or z0 near f.
    const double rim_px = 0.5 * camera.aperture() * camera.px_per_metre;
    const double scale = (rim_px * camera.image_distance() / f + expected) * (1 + f / (z - f)) *
                         (1 + f / (camera.focus - f));
    for (const double paper : {potmesil_px(camera, z), glatzel_px(camera, z),
                               krivanek_px(camera, z), shinya_px(camera, z)}) {
      const double error = std::fabs(paper - expected) / scale;
      worst = std::fmax(worst, error);
      ASSERT_LE(error, 32 * 0x1p-53) << "f " << f << ", focus " << camera.focus << ", depth " << z;
    }
  }
  EXPECT_GT(worst, 0);
}

TEST(OneLens, TheRenderersCameraDiffersByTheDocumentedFactor) {
  const Camera camera{0.05, 2, 1, 1e5};
  Lens cg = lens_of(camera);
  cg.model = LensModel::cg;  // sensor at f instead of the image distance: z0 / (z0 - f) less
  for (const double z : {0.3, 0.9, 4.0, 1e6}) {
    EXPECT_NEAR(reference::coc_px(lens_of(camera), 1920, z) / reference::coc_px(cg, 1920, z),
                1 / (1 - 0.05), 1e-12);
  }
}

CameraValues eye_at(double focus) {
  CameraValues values = eye_values(Eye::retina, 0, 0);
  values.focus_distance_units = focus;
  return values;
}

TEST(Eye, PerceivedDistancesOfThePaper) {
  // Section 3.2: 75 m seen as 0.06 m needs a lens of 5.75 m; section 3.3: 785 m, 60 m.
  CameraValues values = eye_at(75);
  values.perceived_distance_m = 0.06;
  EXPECT_NEAR(make_lens(values, 1, LensModel::cg, 0).aperture_diameter_mm, 5750, 1e-9);
  values = eye_at(785);
  values.perceived_distance_m = 0.06;
  EXPECT_NEAR(make_lens(values, 1, LensModel::cg, 0).aperture_diameter_mm, 60183.333333, 1e-5);
  values.perceived_distance_m.reset();
  values.perceived_scale = 0.06 / 785;
  EXPECT_NEAR(make_lens(values, 1, LensModel::cg, 0).aperture_diameter_mm, 60183.333333, 1e-5);
}

TEST(Eye, CocIsGlatzelsInPixels) {
  CameraValues values = eye_at(75);
  values.perceived_distance_m = 0.06;
  const Lens lens = make_lens(values, 1, LensModel::cg, 0);
  for (const double z : {20.0, 50.0, 75.0, 150.0}) {
    // Eq. 3 with A = 5.75 m, s0 = 17 mm, b = 28000; radius is half of it, whatever the width.
    const double diameter = 28000 * std::fabs(5.75 * 0.017 / 75 * (1 - 75 / z));
    EXPECT_NEAR(2 * std::fabs(reference::coc_px(lens, 640, z)), diameter, 1e-9);
    EXPECT_NEAR(2 * std::fabs(reference::coc_px(lens, 1920, z)), diameter, 1e-9);
  }
}

TEST(Eye, DisplayPresetIsKrivaneks) {
  // C d_s / V_p x resolution, C = 1/2 |V_u - V_p| A / V_u with A = 4 mm and V_p = 24 mm: beyond
  // the focus 1/V_p - 1/V_u = 1/u - 1/p in the thin lens, so C = 1/2 A V_p |1/p - 1/u|.
  CameraValues values = eye_values(Eye::display, 0.6, 3780);
  values.focus_distance_units = 2;
  const Lens lens = make_lens(values, 1, LensModel::cg, 0);
  for (const double u : {0.5, 1.0, 8.0}) {
    const double c_m = 0.5 * 0.004 * 0.024 * std::fabs(1 / 2.0 - 1 / u);
    EXPECT_NEAR(std::fabs(reference::coc_px(lens, 1920, u)), c_m * 0.6 / 0.024 * 3780, 1e-9);
  }
}

TEST(Lens, NumbersBeyondItsRangeAreRefused) {
  for (const double length : {0.0, -1.0, 1e31, std::numeric_limits<double>::quiet_NaN()}) {
    Lens lens;
    lens.focal_length_mm = length;
    expect_error(ErrorKind::usage, {"it must be a number from 1e-30 to 1e+30"},
                 [&] { validate(lens); });
  }
}

TEST(Eye, RefusesContradictions) {
  const auto refuse = [](const std::vector<std::string>& words, const auto& change) {
    CameraValues values = eye_at(75);
    change(values);
    expect_error(ErrorKind::usage, words, [&] { make_lens(values, 1, LensModel::cg, 0); });
  };
  refuse({"perceived_scale", "perceived_distance_m"}, [](CameraValues& v) {
    v.perceived_scale = 1;
    v.perceived_distance_m = 1;
  });
  refuse({"perceived_scale 0", "perceived scale 0"},
         [](CameraValues& v) { v.perceived_scale = 0; });
  refuse({"perceived_distance_m -1", "perceived scale -"},
         [](CameraValues& v) { v.perceived_distance_m = -1; });
  refuse({"finite focus_distance_units"}, [](CameraValues& v) {
    v.focus_distance_units = HUGE_VAL;
    v.perceived_distance_m = 1;
  });
  refuse({"sensor_width_mm", "pixels_per_metre"}, [](CameraValues& v) { v.sensor_width_mm = 36; });
  refuse({"pixels_per_metre", "-5"}, [](CameraValues& v) { v.pixels_per_metre = -5; });
}

}  // namespace
}  // namespace defray::test::lens_models_test
