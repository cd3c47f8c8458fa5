// The same scene in other units is the same picture.
#include <cmath>

#include "lens/camera.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::units_test {
namespace {

/// 50 mm f/2 focused at 3 m, whatever a metre is in the scene.
CameraValues camera(double metres_per_unit) {
  CameraValues values;
  values.focal_length_mm = 50;
  values.fstop = 2;
  values.focus_distance_units = 3 / metres_per_unit;
  return values;
}

TEST(Units, ChangeNoCoc) {
  for (const LensModel model : {LensModel::cg, LensModel::breathing}) {
    const Lens in_metres = make_lens(camera(1), 1, model, 0);
    for (const double unit : {0.001, 0.01, 0.3048, 10.0}) {
      const Lens lens = make_lens(camera(unit), unit, model, 0);
      for (const double metres : {0.3, 1.0, 2.9, 3.0, 7.0, 1e5}) {
        const double expected = reference::coc_px(in_metres, 1920, metres);
        EXPECT_NEAR(reference::coc_px(lens, 1920, metres / unit), expected,
                    1e-9 * (1 + std::fabs(expected)))
            << unit << " " << metres;
      }
    }
  }
}

/// The scene's size is seen in metres, whatever its unit: focused at 3 m it looks as if at 6 cm.
TEST(Units, ChangeNoPerceivedDistance) {
  for (const double unit : {0.001, 1.0, 10.0}) {
    CameraValues values = camera(unit);
    values.perceived_distance_m = 0.06;
    EXPECT_NEAR(make_lens(values, unit, LensModel::cg, 0).aperture_diameter_mm, 25 * 3 / 0.06,
                1e-9);
  }
}

// The thin lens, from its definition: z behind the lens at 1 / (1/f - 1/z), a disc of
// aperture x |image distance difference| / image distance.
TEST(Units, CocIsTheThinLens) {
  const Lens lens = make_lens(camera(0.01), 0.01, LensModel::breathing, 0);  // centimetres
  const double f = 0.05, aperture = 0.025, sensor = 0.036, focus = 3;
  const double film = 1 / (1 / f - 1 / focus);
  for (const double z : {0.4, 1.0, 2.0, 5.0, 100.0}) {
    const double image = 1 / (1 / f - 1 / z);
    const double diameter = aperture * std::fabs(image - film) / image;
    EXPECT_NEAR(std::fabs(reference::coc_px(lens, 1920, z * 100)), diameter / 2 / sensor * 1920,
                1e-6)
        << z;
  }
}

TEST(Units, LimitOfTheCocIsTheNearestQuantum) {
  for (const double limit : {0.01, 1.0, 2.999, 3.001, 17.3}) {
    const Lens lens = make_lens(camera(1), 1, LensModel::cg, limit);
    const Plane depth = {0.01f};  // far beyond any of these limits
    for (Backend* backend : device_and_twins()) {
      const Quanta coc = backend->coc(lens, 1920, depth);
      EXPECT_EQ(std::abs(coc[0]), std::lround(256 * limit)) << limit;
    }
  }
}

}  // namespace
}  // namespace defray::test::units_test
