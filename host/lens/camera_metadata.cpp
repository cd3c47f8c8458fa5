#include "lens/camera_metadata.h"

#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

constexpr double degrees_in_radian = 180 / std::numbers::pi;
/// V-Ray's distance to a target that the camera has not.
constexpr double no_distance = 1e17;

using MetadataField = std::optional<double> CameraValues::*;

const std::pair<const char*, MetadataField> metadata_fields[] = {
    {"focal_length_mm", &CameraValues::focal_length_mm},
    {"sensor_width_mm", &CameraValues::sensor_width_mm},
    {"fov_deg", &CameraValues::fov_deg},
    {"fstop", &CameraValues::fstop},
    {"focus_distance_units", &CameraValues::focus_distance_units},
};

double attribute_value(const ImageFile& file, const CameraAttribute& attribute,
                       const std::string& text) {
  const std::optional<double> value = file.metadata_number(attribute.name);
  if (value && *value > 0) return *value;
  fail(ErrorKind::input,
       "{}: its metadata has '{}' = '{}', which is no {} ({}): it must be a number "
       "above 0; options win over metadata",
       file.path(), attribute.name, text, attribute.field, attribute.written);
}

}  // namespace

const std::vector<CameraAttribute>& camera_attributes() {
  static const std::vector<CameraAttribute> all{
      {"focal_length_mm", "FocalLength", 1, "EXIF"},
      {"focal_length_mm", "Exif:FocalLength", 1, "EXIF"},
      {"focal_length_mm", "nominalFocalLength", 1, "OpenEXR"},
      {"focal_length_mm", "pinholeFocalLength", 1, "OpenEXR"},
      {"focal_length_mm", "exr/nuke/camera/focal", 1, "Nuke"},
      {"focal_length_mm", "nuke/camera/focal", 1, "Nuke"},
      {"focal_length_mm", "cameraFocalLength", 1, "V-Ray"},
      {"focal_length_mm", "vray/cameraFocalLength", 1, "V-Ray"},
      {"focal_length_mm", "IFM_focalLength", 1, "Iray"},
      {"focal_length_mm", "Lens", 1, "Blender"},
      {"sensor_width_mm", "exr/nuke/camera/haperture", 1, "Nuke"},
      {"sensor_width_mm", "nuke/camera/haperture", 1, "Nuke"},
      {"sensor_width_mm", "cameraAperture", 1, "V-Ray"},
      {"sensor_width_mm", "vray/cameraAperture", 1, "V-Ray"},
      {"fov_deg", "cameraFov", 1, "V-Ray"},
      {"fov_deg", "rs/camera/fov", degrees_in_radian, "Redshift"},
      {"fstop", "FNumber", 1, "OpenEXR"},
      {"fstop", "Exif:FNumber", 1, "EXIF"},
      {"fstop", "aperture", 1, "OpenEXR"},
      {"fstop", "cameraFNumber", 1, "V-Ray"},
      {"fstop", "vray/cameraFNumber", 1, "V-Ray"},
      {"fstop", "exr/nuke/camera/fstop", 1, "Nuke"},
      {"fstop", "nuke/camera/fstop", 1, "Nuke"},
      {"focus_distance_units", "focus", 0, "OpenEXR"},
      {"focus_distance_units", "Exif:SubjectDistance", 0, "EXIF"},
      {"focus_distance_units", "exr/nuke/camera/focal_point", 1, "Nuke"},
      {"focus_distance_units", "nuke/camera/focal_point", 1, "Nuke"},
      {"focus_distance_units", "cameraFocusDistance", 1, "V-Ray"},
      {"focus_distance_units", "cameraTargetDistance", 1, "V-Ray"},
      {"focus_distance_units", "vray/cameraFocusDistance", 1, "V-Ray"},
  };
  return all;
}

CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit) {
  CameraValues values;
  values.source = file.path() + "'s metadata";
  for (const auto& [name, field] : metadata_fields) {
    std::vector<std::string> sought;
    for (const CameraAttribute& attribute : camera_attributes()) {
      if (attribute.field != std::string(name)) continue;
      sought.emplace_back(attribute.name);
      const std::optional<std::string> text = file.metadata_text(attribute.name);
      if (!text || values.*field) continue;
      const double number = attribute_value(file, attribute, *text);
      if (number >= no_distance && field == &CameraValues::focus_distance_units) continue;
      values.*field = number * (attribute.factor > 0 ? attribute.factor : 1 / metres_per_unit);
    }
    if (!(values.*field)) values.sought[name] = join(sought, " ");
  }
  if (values.sensor_width_mm) values.fov_deg.reset();  // the same, by another number
  return values;
}

}  // namespace defray
