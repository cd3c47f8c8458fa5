// Lens values under the names that renderers write.
#include "lens/camera_metadata.h"

#include <OpenImageIO/imagebuf.h>

#include "support.h"

namespace defray::test::camera_metadata_test {
namespace {

struct Stored {
  const char* name;
  double stored, expected;  ///< In the attribute's unit, and as a value of a scene in centimetres.
};

/// One attribute beside what else a lens needs.
CameraValues values_of(const Folder& folder, const Stored& stored) {
  const std::string path = folder / "one.exr";
  ImageFile::from_planes({"R"}, {Plane(4, 0.5f)}, 2, 2).write(path);
  OIIO::ImageBuf file(path);
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  file.specmod().attribute(stored.name, static_cast<float>(stored.stored));
  file.write(folder / "with.exr");
  return camera_from_metadata(ImageFile::read(folder / "with.exr"), 0.01);
}

void expect_values(std::optional<double> CameraValues::*field, const std::vector<Stored>& all) {
  const Folder folder;
  for (const Stored& stored : all) {
    const CameraValues values = values_of(folder, stored);
    ASSERT_TRUE(values.*field) << stored.name;
    EXPECT_NEAR(*(values.*field), stored.expected, 1e-4) << stored.name;
  }
}

TEST(CameraMetadata, FocalLengthsAreMillimetres) {
  expect_values(&CameraValues::focal_length_mm, {{"nominalFocalLength", 35, 35},
                                                 {"pinholeFocalLength", 35, 35},
                                                 {"exr/nuke/camera/focal", 35, 35},
                                                 {"nuke/camera/focal", 35, 35},
                                                 {"Exif:FocalLength", 35, 35},
                                                 {"cameraFocalLength", 35, 35},
                                                 {"vray/cameraFocalLength", 35, 35},
                                                 {"CameraFocalLength", 35, 35},
                                                 {"IFM_focalLength", 35, 35},
                                                 {"Lens", 35, 35}});
}

TEST(CameraMetadata, SensorsAreMillimetresAndFieldsOfViewDegrees) {
  expect_values(&CameraValues::sensor_width_mm, {{"exr/nuke/camera/haperture", 24, 24},
                                                 {"nuke/camera/haperture", 24, 24},
                                                 {"cameraAperture", 24, 24},
                                                 {"vray/cameraAperture", 24, 24},
                                                 {"CameraFilmApertureHorizontal", 24, 24}});
  // Redshift's may be either.
  expect_values(
      &CameraValues::fov_deg,
      {{"cameraFov", 40, 40}, {"rs/camera/fov", 1.0471976, 60}, {"rs/camera/fov", 40, 40}});
}

TEST(CameraMetadata, FStopsAreThemselves) {
  expect_values(&CameraValues::fstop, {{"FNumber", 2.8, 2.8},
                                       {"Exif:FNumber", 2.8, 2.8},
                                       {"aperture", 2.8, 2.8},
                                       {"cameraFNumber", 2.8, 2.8},
                                       {"vray/cameraFNumber", 2.8, 2.8},
                                       {"exr/nuke/camera/fstop", 2.8, 2.8},
                                       {"nuke/camera/fstop", 2.8, 2.8},
                                       {"rs/camera/FStop", 2.8, 2.8}});
}

TEST(CameraMetadata, FocusIsMetresOfCamerasAndUnitsOfScenes) {
  expect_values(&CameraValues::focus_distance_units, {{"focus", 3, 300},
                                                      {"Exif:SubjectDistance", 3, 300},
                                                      {"exr/nuke/camera/focal_point", 3, 3},
                                                      {"nuke/camera/focal_point", 3, 3},
                                                      {"cameraFocusDistance", 3, 3},
                                                      {"cameraTargetDistance", 3, 3},
                                                      {"vray/cameraFocusDistance", 3, 3},
                                                      {"rs/camera/DOFFocusDistance", 3, 3}});
}

}  // namespace
}  // namespace defray::test::camera_metadata_test
