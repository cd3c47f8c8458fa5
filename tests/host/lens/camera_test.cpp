// Values of a camera: what is said later wins over what a file says.
#include "lens/camera.h"

#include <cmath>

#include "support.h"

namespace defray::test::camera_test {
namespace {

using Field = std::optional<double> CameraValues::*;

/// Each field with a value of its own.
CameraValues from_a_file() {
  CameraValues v;
  v.focal_length_mm = 50;
  v.sensor_width_mm = 36;
  v.fstop = 2;
  v.focus_distance_units = 3;
  v.perceived_scale = 4;
  v.perceived_distance_m = 5;
  v.source = "camera.json";
  return v;
}

constexpr Field fields[] = {
    &CameraValues::focal_length_mm,      &CameraValues::sensor_width_mm,
    &CameraValues::sensor_height_mm,     &CameraValues::fov_deg,
    &CameraValues::pixels_per_metre,     &CameraValues::fstop,
    &CameraValues::aperture_diameter_mm, &CameraValues::focus_distance_units,
    &CameraValues::perceived_scale,      &CameraValues::perceived_distance_m};

TEST(CameraValues, AValueWinsOverAFilesAndChangesNoOther) {
  for (const Field field : fields) {
    CameraValues over, expected = from_a_file();
    over.*field = expected.*field = 7;
    // These say the same thing as another.
    if (field == &CameraValues::pixels_per_metre || field == &CameraValues::sensor_height_mm ||
        field == &CameraValues::fov_deg) {
      expected.sensor_width_mm.reset();
    }
    if (field == &CameraValues::aperture_diameter_mm) expected.fstop.reset();
    const CameraValues values = from_a_file().overridden_by(over);
    for (const Field other : fields) EXPECT_EQ(values.*other, expected.*other);
    EXPECT_EQ(values.source, "camera.json");
  }
}

TEST(Camera, ExplicitValuesWin) {
  CameraValues file, typed;
  file.focal_length_mm = 50;
  file.aperture_diameter_mm = 20;
  file.focus_distance_units = 3;
  typed.fstop = 4;
  const Lens lens = make_lens(file.overridden_by(typed), 1, LensModel::cg, 0);
  EXPECT_DOUBLE_EQ(lens.aperture_diameter_mm, 12.5);
  EXPECT_DOUBLE_EQ(lens.focus_distance_units, 3);
  EXPECT_DOUBLE_EQ(lens.sensor_width_mm, 36);
}

TEST(Camera, SaysWhatIsMissing) {
  expect_error(ErrorKind::usage, {"focus_distance_units", "focal_length_mm", "fstop"},
               [] { make_lens({}, 1, LensModel::cg, 0); });
  CameraValues both;
  both.focal_length_mm = 50;
  both.fstop = 2;
  both.aperture_diameter_mm = 20;
  both.focus_distance_units = 3;
  expect_error(ErrorKind::usage, {"one of them"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  both.aperture_diameter_mm.reset();
  for (const double f : {0.0, -2.0, double{NAN}}) {
    both.fstop = f;
    expect_error(ErrorKind::usage, {"f-number"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  }
}

}  // namespace
}  // namespace defray::test::camera_test
