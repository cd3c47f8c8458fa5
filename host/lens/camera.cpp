#include "lens/camera.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

std::optional<double> scaled(std::optional<double> value, double factor) {
  if (value) *value *= factor;
  return value;
}

std::optional<double> first_number(const ImageFile& file, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    if (const auto value = file.metadata_number(key)) return value;
  }
  return std::nullopt;
}

template <typename T>
std::optional<T> either(const std::optional<T>& first, const std::optional<T>& second) {
  return first ? first : second;
}

}  // namespace

CameraValues CameraValues::overridden_by(const CameraValues& over) const {
  CameraValues values;
  values.source = source;
  values.focal_length_mm = either(over.focal_length_mm, focal_length_mm);
  // So do the sensor's width and the pixels in a metre.
  const bool replaces_sensor = over.sensor_width_mm || over.pixels_per_metre;
  values.sensor_width_mm = replaces_sensor ? over.sensor_width_mm : sensor_width_mm;
  values.pixels_per_metre = replaces_sensor ? over.pixels_per_metre : pixels_per_metre;
  values.perceived_scale = either(over.perceived_scale, perceived_scale);
  values.perceived_distance_m = either(over.perceived_distance_m, perceived_distance_m);
  values.focus_distance_units = either(over.focus_distance_units, focus_distance_units);
  // The f-number and the diameter say the same thing: stating one replaces both.
  const bool replaces_aperture = over.fstop || over.aperture_diameter_mm;
  values.fstop = replaces_aperture ? over.fstop : fstop;
  values.aperture_diameter_mm =
      replaces_aperture ? over.aperture_diameter_mm : aperture_diameter_mm;
  return values;
}

CameraValues eye_values(Eye eye, double display_distance_m, double display_px_per_metre) {
  CameraValues values;
  values.aperture_diameter_mm = eye == Eye::retina ? 4.6 : 4;
  values.focal_length_mm = eye == Eye::retina ? 17 : 24;
  const double magnification = display_distance_m / (*values.focal_length_mm / 1000);
  values.pixels_per_metre = eye == Eye::retina ? 28000 : display_px_per_metre * magnification;
  return values;
}

CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit) {
  CameraValues values;
  // EXR standard attributes first (focus is in metres), then Nuke's and V-Ray's.
  values.focal_length_mm =
      first_number(file, {"FocalLength", "Exif:FocalLength", "exr/nuke/camera/focal",
                          "nuke/camera/focal", "cameraFocalLength", "vray/cameraFocalLength"});
  values.sensor_width_mm = first_number(file, {"exr/nuke/camera/haperture", "nuke/camera/haperture",
                                               "cameraAperture", "vray/cameraAperture"});
  values.fstop = first_number(file, {"FNumber", "Exif:FNumber", "aperture", "cameraFNumber",
                                     "vray/cameraFNumber", "exr/nuke/camera/fstop"});
  values.focus_distance_units =
      scaled(first_number(file, {"focus", "Exif:SubjectDistance"}), 1 / metres_per_unit);
  if (!values.focus_distance_units) {  // scene units already
    values.focus_distance_units = first_number(
        file, {"exr/nuke/camera/focal_point", "nuke/camera/focal_point", "cameraFocusDistance",
               "cameraTargetDistance", "vray/cameraFocusDistance"});
  }
  return values;
}

namespace {

/// m of Glatzel & Wilhelm, eq. 5: the perceived size of the scene, 1 where nothing is asked for.
double perceived_scale(const CameraValues& values, double metres_per_unit) {
  if (values.perceived_scale && values.perceived_distance_m) {
    fail(ErrorKind::usage, "{} and {} say the same thing: give one of them",
         field("perceived_scale"), field("perceived_distance_m"));
  }
  double scale = values.perceived_scale.value_or(1);
  if (values.perceived_distance_m) {
    scale = *values.perceived_distance_m / (*values.focus_distance_units * metres_per_unit);
    if (std::isinf(*values.focus_distance_units)) {
      fail(ErrorKind::usage, "{} needs a finite {}; {} does not", field("perceived_distance_m"),
           field("focus_distance_units"), field("perceived_scale"));
    }
  }
  if (!(scale > 0) || !std::isfinite(scale)) {
    const bool is_scale = values.perceived_scale.has_value();
    fail(ErrorKind::usage, "{} {} makes the perceived scale {}: allowed are finite numbers above 0",
         field(is_scale ? "perceived_scale" : "perceived_distance_m"),
         is_scale ? *values.perceived_scale : *values.perceived_distance_m, scale);
  }
  return scale;
}

}  // namespace

Lens make_lens(const CameraValues& values, double metres_per_unit, LensModel model,
               double max_coc_px) {
  std::vector<std::string> missing;
  if (!values.focus_distance_units) missing.push_back(field("focus_distance_units"));
  if (!values.focal_length_mm) missing.push_back(field("focal_length_mm"));
  if (!values.fstop && !values.aperture_diameter_mm) {
    missing.push_back(field("fstop") + " or " + field("aperture_diameter_mm"));
  }
  if (!missing.empty()) {
    fail(ErrorKind::usage, "the lens is not complete: give {}{}", join(missing, ", "),
         values.source.empty() ? " (or " + field("camera") + ")"
                               : fmt::format("; {} has no such value", values.source));
  }
  if (values.fstop && values.aperture_diameter_mm) {
    fail(ErrorKind::usage, "{} and {} say the same thing: give one of them", field("fstop"),
         field("aperture_diameter_mm"));
  }
  if (values.fstop && !(*values.fstop > 0)) {
    fail(ErrorKind::usage, "f-number is {}: it must be above 0", *values.fstop);
  }
  if (values.sensor_width_mm && values.pixels_per_metre) {
    fail(ErrorKind::usage, "{} and {} say the same thing: give one of them",
         field("sensor_width_mm"), field("pixels_per_metre"));
  }
  if (values.pixels_per_metre && !(*values.pixels_per_metre > 0)) {
    fail(ErrorKind::usage, "{} is {}: it must be above 0", field("pixels_per_metre"),
         *values.pixels_per_metre);
  }
  Lens lens;
  lens.focal_length_mm = *values.focal_length_mm;
  lens.pixels_per_metre = values.pixels_per_metre.value_or(0);
  lens.sensor_width_mm = values.sensor_width_mm.value_or(lens.sensor_width_mm);
  lens.focus_distance_units = *values.focus_distance_units;
  lens.aperture_diameter_mm =
      values.fstop ? lens.focal_length_mm / *values.fstop : *values.aperture_diameter_mm;
  lens.metres_per_unit = metres_per_unit;
  lens.model = model;
  lens.max_coc_px = max_coc_px;
  validate(lens);  // first: the perceived distance divides by the focus
  lens.aperture_diameter_mm /= perceived_scale(values, metres_per_unit);
  validate(lens);
  return lens;
}

}  // namespace defray
