// Lens values under the names that renderers write.
#include "lens/camera_metadata.h"

#include <OpenImageIO/imagebuf.h>

#include <cmath>
#include <functional>

#include "support.h"

namespace defray::test::camera_metadata_test {
namespace {

struct Stored {
  const char* name;
  double stored, expected;  ///< In the attribute's unit, and as a value of a scene in centimetres.
};

/// What a file with these attributes says.
CameraValues values_of(const Folder& folder,
                       const std::function<void(OIIO::ImageSpec&)>& with_attributes) {
  const std::string path = folder / "one.exr";
  ImageFile::from_planes({"R"}, {Plane(4, 0.5f)}, 2, 2).write(path);
  OIIO::ImageBuf file(path);
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  with_attributes(file.specmod());
  file.write(folder / "with.exr");
  return camera_from_metadata(ImageFile::read(folder / "with.exr"), 0.01);
}

void expect_values(std::optional<double> CameraValues::*field, const std::vector<Stored>& all) {
  const Folder folder;
  for (const Stored& stored : all) {
    const CameraValues values = values_of(folder, [&](OIIO::ImageSpec& spec) {
      spec.attribute(stored.name, static_cast<float>(stored.stored));
    });
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
                                                 {"focalLength", 35, 35},
                                                 {"IFM_focalLength", 35, 35},
                                                 {"Lens", 35, 35}});
}

TEST(CameraMetadata, SensorsAreMillimetresAndFieldsOfViewDegrees) {
  expect_values(&CameraValues::sensor_width_mm, {{"exr/nuke/camera/haperture", 24, 24},
                                                 {"nuke/camera/haperture", 24, 24},
                                                 {"cameraAperture", 24, 24},
                                                 {"vray/cameraAperture", 24, 24},
                                                 {"CameraFilmApertureHorizontal", 24, 24},
                                                 {"horizontalAperture", 24, 24}});
  // Redshift's may be either.
  expect_values(&CameraValues::fov_deg, {{"cameraFov", 40, 40},
                                         {"rs/camera/fov", 1.0471976, 60},
                                         {"rs/camera/fov", 40, 40},
                                         {"RSCameraFOV", 40, 40}});
}

TEST(CameraMetadata, FStopsAreThemselves) {
  expect_values(&CameraValues::fstop, {{"FNumber", 2.8, 2.8},
                                       {"Exif:FNumber", 2.8, 2.8},
                                       {"aperture", 2.8, 2.8},
                                       {"cameraFNumber", 2.8, 2.8},
                                       {"vray/cameraFNumber", 2.8, 2.8},
                                       {"exr/nuke/camera/fstop", 2.8, 2.8},
                                       {"nuke/camera/fstop", 2.8, 2.8},
                                       {"rs/camera/FStop", 2.8, 2.8},
                                       {"fStop", 2.8, 2.8}});
}

TEST(CameraMetadata, FocusIsMetresOfCamerasAndUnitsOfScenes) {
  expect_values(&CameraValues::focus_distance_units, {{"focus", 3, 300},
                                                      {"Exif:SubjectDistance", 3, 300},
                                                      {"exr/nuke/camera/focal_point", 3, 3},
                                                      {"nuke/camera/focal_point", 3, 3},
                                                      {"cameraFocusDistance", 3, 3},
                                                      {"cameraTargetDistance", 3, 3},
                                                      {"vray/cameraFocusDistance", 3, 3},
                                                      {"rs/camera/DOFFocusDistance", 3, 3},
                                                      {"focusDistance", 3, 3}});
}

/// A camera somewhere, turned and in a scene of another scale, whose frame spans 2 x `tangent` and
/// goes from `left` to `right` in NDC; the axis is `shift` of half the width off the middle.
std::vector<float> projection(double tangent, double left, double right, double shift) {
  const double scale = 7, sine = 0.6, cosine = 0.8, near = 0.1;
  const double half = (right - left) / 2, f = half / tangent;
  const double middle = (left + right) / 2;
  const double rotation[4][4] = {{cosine * scale, 0, -sine * scale, 0},
                                 {0, scale, 0, 0},
                                 {sine * scale, 0, cosine * scale, 0},
                                 {3, -2, 11, 1}};
  const double lens[4][4] = {
      {f, 0, 0, 0}, {0, f * 1.5, 0, 0}, {middle + shift * half, middle, 1, 1}, {0, 0, -near, 0}};
  std::vector<float> matrix(16);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += rotation[i][k] * lens[k][j];
      matrix[4 * i + j] = static_cast<float>(sum);
    }
  }
  return matrix;
}

CameraValues values_of_matrix(const Folder& folder, const std::string& name,
                              const std::vector<float>& matrix) {
  return values_of(folder, [&](OIIO::ImageSpec& spec) {
    spec.attribute(name, OIIO::TypeMatrix44, matrix.data());
  });
}

TEST(CameraMetadata, ProjectionsSpanFieldsOfView) {
  const Folder folder;
  const double tangent = 0.36, fov_deg = 39.597752;  // 50 mm before 36
  const struct {
    const char* what;
    double left, right, shift;
  } cases[] = {{"OpenEXR's", 0, 1, 0},
               {"RenderMan's", -1, 1, 0},
               {"OpenEXR's with a shifted lens", 0, 1, -0.4},
               {"RenderMan's with a shifted lens", -1, 1, 0.2}};
  for (const auto& c : cases) {
    const std::vector<float> matrix = projection(tangent, c.left, c.right, c.shift);
    for (const std::string name : {"worldToNDC", "worldToScreen"}) {
      const CameraValues values = values_of_matrix(folder, name, matrix);
      ASSERT_TRUE(values.fov_deg) << c.what << ", " << name;
      EXPECT_NEAR(*values.fov_deg, fov_deg, 1e-3) << c.what << ", " << name;
    }
  }
}

TEST(CameraMetadata, WhatIsNoProjectionIsRefused) {
  const Folder folder;
  std::vector<float> orthographic(16);
  for (const std::size_t i : {0, 5, 10, 15}) orthographic[i] = 1;
  std::vector<float> flat = projection(0.36, -1, 1, 0);
  for (std::size_t i = 0; i < 16; i += 4) flat[i] = 0;
  std::vector<float> broken = projection(0.36, -1, 1, 0);
  broken[3] = NAN;
  // Neither about the middle of 0 to 1, nor of -1 to 1.
  const std::vector<float> shifted = projection(0.36, -1, 1, 0.3);
  for (const std::vector<float>& matrix :
       {orthographic, flat, broken, shifted, std::vector<float>(16)}) {
    try {
      values_of_matrix(folder, "worldToNDC", matrix);
      ADD_FAILURE() << matrix[0];
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      const std::string text = error.what();
      EXPECT_NE(text.find("with.exr: its metadata has 'worldToNDC'"), std::string::npos) << text;
      EXPECT_NE(text.find("below 180 degrees"), std::string::npos) << text;
    }
  }
}

TEST(CameraMetadata, NamesCountBehindAPrefix) {
  const Folder folder;
  for (const std::string before : {"", "exr/", "vray/"}) {
    const CameraValues values = values_of(folder, [&](OIIO::ImageSpec& spec) {
      spec.attribute(before + "focalLength", 35.0f);
      spec.attribute(before + "cameraFov", 40.0f);
      spec.attribute(before + "fStop", 2.0f);
      spec.attribute(before + "cameraTargetDistance", 6.0f);
    });
    EXPECT_EQ(values.focal_length_mm, 35) << before;
    EXPECT_EQ(values.fov_deg, 40) << before;
    EXPECT_EQ(values.fstop, 2) << before;
    EXPECT_EQ(values.focus_distance_units, 6) << before;
    EXPECT_FALSE(values.fit) << before;
  }
  const std::vector<float> matrix = projection(1, -1, 1, 0);
  const CameraValues projected = values_of_matrix(folder, "exr/worldToNDC", matrix);
  EXPECT_NEAR(projected.fov_deg.value_or(0), 90, 1e-3);
  EXPECT_EQ(projected.fit, SensorFit::horizontal);
}

TEST(CameraMetadata, ASensorCountsBesideAProjection) {
  const Folder folder;
  const std::vector<float> matrix = projection(0.36, -1, 1, 0);
  const CameraValues values = values_of(folder, [&](OIIO::ImageSpec& spec) {
    spec.attribute("worldToNDC", OIIO::TypeMatrix44, matrix.data());
    spec.attribute("CameraFilmApertureHorizontal", 24.0f);
  });
  EXPECT_EQ(values.sensor_width_mm, 24);
  EXPECT_FALSE(values.fov_deg);
}

}  // namespace
}  // namespace defray::test::camera_metadata_test
