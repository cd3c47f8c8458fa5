// Values of a camera: what is said later wins over what a file says.
#include "lens/camera.h"

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
    &CameraValues::pixels_per_metre,     &CameraValues::fstop,
    &CameraValues::aperture_diameter_mm, &CameraValues::focus_distance_units,
    &CameraValues::perceived_scale,      &CameraValues::perceived_distance_m};

TEST(CameraValues, AValueWinsOverAFilesAndChangesNoOther) {
  for (const Field field : fields) {
    CameraValues over, expected = from_a_file();
    over.*field = expected.*field = 7;
    // These say the same thing as another.
    if (field == &CameraValues::pixels_per_metre) expected.sensor_width_mm.reset();
    if (field == &CameraValues::aperture_diameter_mm) expected.fstop.reset();
    const CameraValues values = from_a_file().overridden_by(over);
    for (const Field other : fields) EXPECT_EQ(values.*other, expected.*other);
    EXPECT_EQ(values.source, "camera.json");
  }
}

}  // namespace
}  // namespace defray::test::camera_test
