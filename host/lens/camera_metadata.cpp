#include "lens/camera_metadata.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/vec3.h"

namespace defray {
namespace {

constexpr double degrees_in_radian = 180 / std::numbers::pi;
/// Fields of view are below this.
constexpr double half_turn_deg = 180;
/// How far off a frame's middle the optical axis may lie, NDC.
constexpr double largest_shift = 0.25;
/// V-Ray's distance to a target that the camera has not.
constexpr double no_distance = 1e17;

using MetadataField = std::optional<double> CameraValues::*;

struct MetadataValue {
  const char* name;
  const char* words;
  MetadataField field;
};

const MetadataValue metadata_values[] = {
    {"focal_length_mm", "focal length", &CameraValues::focal_length_mm},
    {"sensor_width_mm", "sensor width", &CameraValues::sensor_width_mm},
    {"fov_deg", "field of view", &CameraValues::fov_deg},
    {"fstop", "f-number", &CameraValues::fstop},
    {"focus_distance_units", "focus distance", &CameraValues::focus_distance_units},
};

bool is_fov(const CameraAttribute& a) { return a.field == std::string("fov_deg"); }

/// The field of view, degrees, of a camera with this projection; empty where it is none of a
/// perspective camera. OpenEXR's worldToNDC goes from 0 to 1 over the frame, that of RenderMan and
/// others from -1 to 1: where the optical axis lies tells, in the one's middle or the other's, or
/// beside it by a shifted lens; none in between.
std::optional<double> fov_of(const Matrix4& world_to_ndc) {
  const auto column = [&](std::size_t i) {
    const auto at = [&](std::size_t j) { return static_cast<double>(world_to_ndc[4 * j + i]); };
    return Vec3{at(0), at(1), at(2)};
  };
  // A row vector times the matrix: what x is divided by grows along the axis.
  const Vec3 axis = column(3);
  const double squared = dot(axis, axis);
  if (!(squared > 0)) return std::nullopt;
  const double x = dot(column(0), axis) / squared, y = dot(column(1), axis) / squared;
  const Vec3 across = column(0) - axis * x;
  const double focal = std::sqrt(dot(across, across) / squared);  // NDC per unit at distance 1
  const double to_zero = std::hypot(x, y), to_half = std::hypot(x - 0.5, y - 0.5);
  if (!(std::min(to_zero, to_half) < largest_shift)) return std::nullopt;
  const double half_width = to_zero < to_half ? 1 : 0.5;
  const double fov_deg = 2 * std::atan(half_width / focal) * degrees_in_radian;
  return fov_deg > 0 && fov_deg < half_turn_deg ? std::optional(fov_deg) : std::nullopt;
}

/// What a number says; nothing where it cannot be meant.
std::optional<double> value_of(const CameraAttribute& a, double number) {
  const bool is_focus = a.field == std::string("focus_distance_units");
  if (!(number > 0) || (std::isinf(number) && !is_focus)) return std::nullopt;
  double factor = a.factor > 0 ? a.factor : 1;
  // Redshift's manual says radians; what scripts find in its files is degrees.
  if (a.factor == degrees_in_radian && number > std::numbers::pi) factor = 1;
  const double value = number * factor;
  return is_fov(a) && value >= half_turn_deg ? std::nullopt : std::optional(value);
}

double usable_value(const ImageFile& file, const FoundAttribute& found, const char* words) {
  if (found.value) return *found.value;
  const CameraAttribute& attribute = found.attribute;
  fail(ErrorKind::input,
       "{}: its metadata has '{}' = '{}', which is no {} ({}): it must be a number above 0{}; {} "
       "wins over it",
       file.path(), found.name, found.text, words, attribute.written,
       is_fov(attribute) ? ", below 180 degrees" : "", field(attribute.field));
}

/// Whether these say what the field does, by this number or another.
bool is_stated(const CameraValues& by, MetadataField field) {
  const bool is_sensor = field == &CameraValues::sensor_width_mm || field == &CameraValues::fov_deg;
  if (is_sensor) {
    return by.sensor_width_mm || by.sensor_height_mm || by.fov_deg || by.pixels_per_metre;
  }
  return by.*field || (field == &CameraValues::fstop && by.aperture_diameter_mm);
}

}  // namespace

const std::vector<CameraAttribute>& camera_attributes() {
  static const std::vector<CameraAttribute> all{
      {"focal_length_mm", "FocalLength", 1, "EXIF, USD"},
      {"focal_length_mm", "Exif:FocalLength", 1, "EXIF"},
      {"focal_length_mm", "nominalFocalLength", 1, "OpenEXR"},
      {"focal_length_mm", "pinholeFocalLength", 1, "OpenEXR"},
      {"focal_length_mm", "nuke/camera/focal", 1, "Nuke"},
      {"focal_length_mm", "cameraFocalLength", 1, "V-Ray, Arnold"},
      {"focal_length_mm", "IFM_focalLength", 1, "Iray"},
      {"focal_length_mm", "Lens", 1, "Blender"},
      {"sensor_width_mm", "nuke/camera/haperture", 1, "Nuke"},
      {"sensor_width_mm", "cameraAperture", 1, "V-Ray"},
      {"sensor_width_mm", "CameraFilmApertureHorizontal", 1, "Arnold"},
      {"sensor_width_mm", "horizontalAperture", 1, "USD"},
      {"fov_deg", "cameraFov", 1, "V-Ray"},
      {"fov_deg", "rs/camera/fov", degrees_in_radian, "Redshift"},
      {"fov_deg", "RSCameraFOV", 1, "Redshift"},
      {"fov_deg", "worldToNDC", 1, "OpenEXR, RenderMan"},
      {"fov_deg", "worldToScreen", 1, "OpenImageIO"},
      {"fstop", "FNumber", 1, "OpenEXR"},
      {"fstop", "Exif:FNumber", 1, "EXIF"},
      {"fstop", "aperture", 1, "OpenEXR"},
      {"fstop", "cameraFNumber", 1, "V-Ray"},
      {"fstop", "nuke/camera/fstop", 1, "Nuke"},
      {"fstop", "rs/camera/FStop", 1, "Redshift"},
      {"fstop", "fStop", 1, "USD"},
      {"focus_distance_units", "focus", 0, "OpenEXR"},
      {"focus_distance_units", "Exif:SubjectDistance", 0, "EXIF"},
      {"focus_distance_units", "nuke/camera/focal_point", 1, "Nuke"},
      {"focus_distance_units", "cameraFocusDistance", 1, "V-Ray"},
      {"focus_distance_units", "cameraTargetDistance", 1, "V-Ray"},
      {"focus_distance_units", "rs/camera/DOFFocusDistance", 1, "Redshift"},
      {"focus_distance_units", "focusDistance", 1, "USD"},
  };
  return all;
}

std::optional<FoundAttribute> find_attribute(const ImageFile& file,
                                             const CameraAttribute& attribute) {
  std::optional<std::string> name;
  for (const char* before : {"", "exr/", "vray/"}) {
    if (!name) name = file.metadata_name(before + std::string(attribute.name));
  }
  if (!name) return std::nullopt;
  FoundAttribute found{attribute, *name, *file.metadata_text(*name), {}};
  if (const auto matrix = file.metadata_matrix(*name)) {
    found.is_matrix = true;
    if (is_fov(attribute)) found.value = fov_of(*matrix);
    if (found.value) found.text = fmt::format("{:.6g}", *found.value);
    return found;
  }
  const std::optional<double> number = file.metadata_number(*name);
  if (!number) return found;
  const bool is_focus = attribute.field == std::string("focus_distance_units");
  if (is_focus && *number >= no_distance && !std::isinf(*number)) return std::nullopt;
  found.value = value_of(attribute, *number);
  return found;
}

CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit,
                                  const CameraValues& stated) {
  CameraValues values;
  values.source = file.path() + "'s metadata";
  for (const auto& [name, words, field] : metadata_values) {
    if (is_stated(stated, field) || is_stated(values, field)) continue;
    std::vector<std::string> sought;
    for (const CameraAttribute& attribute : camera_attributes()) {
      if (attribute.field != std::string(name)) continue;
      sought.emplace_back(attribute.name);
      const auto found = values.*field ? std::nullopt : find_attribute(file, attribute);
      if (!found) continue;
      const double value = usable_value(file, *found, words);
      values.*field = attribute.factor > 0 ? value : value / metres_per_unit;
      if (found->is_matrix) values.fit = SensorFit::horizontal;
    }
    if (!(values.*field)) values.sought[name] = join(sought, " ");
  }
  return values;
}

}  // namespace defray
