#include "lens/camera.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"

namespace defray {
namespace {

template <typename T>
std::optional<T> either(const std::optional<T>& first, const std::optional<T>& second) {
  return first ? first : second;
}

}  // namespace

CameraValues CameraValues::overridden_by(const CameraValues& over) const {
  CameraValues values;
  values.source = source;
  values.sought = sought;
  values.notes = notes;
  values.notes.insert(values.notes.end(), over.notes.begin(), over.notes.end());
  values.focal_length_mm = either(over.focal_length_mm, focal_length_mm);
  // One of them says what the others do.
  const bool replaces_sensor =
      over.sensor_width_mm || over.sensor_height_mm || over.fov_deg || over.pixels_per_metre;
  const CameraValues& sensor = replaces_sensor ? over : *this;
  values.sensor_width_mm = sensor.sensor_width_mm;
  values.sensor_height_mm = sensor.sensor_height_mm;
  values.fov_deg = sensor.fov_deg;
  values.pixels_per_metre = sensor.pixels_per_metre;
  values.sensor_source = sensor.sensor_source;
  values.fit = over.fit || over.sensor_height_mm ? over.fit : fit;
  values.perceived_scale = either(over.perceived_scale, perceived_scale);
  values.perceived_distance_m = either(over.perceived_distance_m, perceived_distance_m);
  const CameraValues& focus = over.focus_distance_units ? over : *this;
  values.focus_distance_units = focus.focus_distance_units;
  values.focus_end_units = focus.focus_end_units;
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

/// Throws Error(usage) that names every value that is missing, and where it was sought.
void refuse_missing(const CameraValues& v) {
  std::vector<std::string> missing, sought;
  const auto check = [&](bool is_there, const std::string& what, const char* name) {
    if (is_there) return;
    missing.push_back(what);
    if (const auto found = v.sought.find(name); found != v.sought.end()) {
      sought.push_back(found->second);
    }
  };
  check(v.focus_distance_units.has_value(), field("focus_distance_units"), "focus_distance_units");
  check(v.focal_length_mm.has_value(), field("focal_length_mm"), "focal_length_mm");
  check(v.fstop || v.aperture_diameter_mm, field("fstop") + " or " + field("aperture_diameter_mm"),
        "fstop");
  if (missing.empty()) return;
  std::string why = v.source.empty() ? " (or " + field("camera") + ")"
                                     : fmt::format("; {} has no such value", v.source);
  if (!sought.empty()) why += ", sought as " + join(sought, "; ");
  for (const std::string& note : v.notes)
    why += (why.ends_with('?') ? " Note: " : ". Note: ") + note;
  fail(ErrorKind::usage, "the lens is not complete: give {}{}", join(missing, ", "), why);
}

/// Throws Error(usage) for two values that say the same thing.
void refuse_doubled(const CameraValues& v) {
  const auto refuse = [](bool first, const char* name, bool second, const char* other) {
    if (!first || !second) return;
    fail(ErrorKind::usage, "{} and {} say the same thing: give one of them", field(name),
         field(other));
  };
  const auto refuse_sensors = [&](bool first, const char* name, bool second, const char* other) {
    if (!first || !second || v.sensor_source.empty()) return refuse(first, name, second, other);
    fail(ErrorKind::input, "{}: keys '{}' and '{}' say the same thing: leave one of them",
         v.sensor_source, name, other);
  };
  refuse(v.fstop.has_value(), "fstop", v.aperture_diameter_mm.has_value(), "aperture_diameter_mm");
  const std::pair<const char*, bool> sensors[] = {
      {"sensor_width_mm", v.sensor_width_mm.has_value() && v.fit != SensorFit::vertical},
      {"sensor_height_mm", v.sensor_height_mm.has_value() &&
                               v.fit.value_or(SensorFit::vertical) == SensorFit::vertical},
      {"fov_deg", v.fov_deg.has_value()},
      {"pixels_per_metre", v.pixels_per_metre.has_value()}};
  for (const auto& [name, is_there] : sensors) {
    for (const auto& [other, is_other_there] : sensors) {
      if (other == name) break;
      refuse_sensors(is_other_there, other, is_there, name);
    }
  }
}

/// Throws Error(usage) for a height that would span nothing. A file may have both, as Blender does:
/// the fit says which one counts.
void refuse_idle_height(const CameraValues& v) {
  const bool is_of_width = v.fit && *v.fit != SensorFit::vertical;
  const bool has_both = v.sensor_width_mm && !v.sensor_source.empty();
  if (!v.sensor_height_mm || has_both || !is_of_width) return;
  const std::string from = v.sensor_source.empty() ? "" : v.sensor_source + ": ";
  fail(ErrorKind::usage, "{}{} goes with {} vertical, found {}: give {}, or another {}", from,
       field("sensor_height_mm"), field("fit"), *v.fit == SensorFit::longer ? "auto" : "horizontal",
       field("sensor_width_mm"), field("fit"));
}

/// The sensor across the display window's width, mm.
double sensor_across(const CameraValues& v, const Window& display) {
  const bool has_height_alone = v.sensor_height_mm && !v.sensor_width_mm;
  const SensorFit fit =
      v.fit.value_or(has_height_alone ? SensorFit::vertical : SensorFit::horizontal);
  const bool is_upright = display.height > display.width;
  const bool spans_height = fit == SensorFit::vertical || (fit == SensorFit::longer && is_upright);
  double across = v.sensor_width_mm.value_or(Lens().sensor_width_mm);
  if (v.fov_deg) {
    if (!(*v.fov_deg > 0 && *v.fov_deg < 180)) {
      fail(ErrorKind::usage, "{} is {} degrees: allowed are numbers above 0, below 180",
           field("fov_deg"), *v.fov_deg);
    }
    across = 2 * *v.focal_length_mm * std::tan(*v.fov_deg * std::numbers::pi / 360);
  } else if (fit == SensorFit::vertical) {
    if (!v.sensor_height_mm) {
      fail(ErrorKind::usage, "{} vertical needs {} or {}", field("fit"), field("sensor_height_mm"),
           field("fov_deg"));
    }
    across = *v.sensor_height_mm;
  }
  return spans_height ? across * display.width / display.height : across;
}

}  // namespace

Lens make_lens(const CameraValues& values, double metres_per_unit, LensModel model,
               double max_coc_px, const Window& display) {
  refuse_missing(values);
  refuse_doubled(values);
  if (values.fit) require_named("fit", *values.fit, SensorFit::longer);
  refuse_idle_height(values);
  if (values.fstop && !(*values.fstop > 0)) {
    fail(ErrorKind::usage, "f-number is {}: it must be above 0", *values.fstop);
  }
  if (values.pixels_per_metre && !(*values.pixels_per_metre > 0)) {
    fail(ErrorKind::usage, "{} is {}: it must be above 0", field("pixels_per_metre"),
         *values.pixels_per_metre);
  }
  Lens lens;
  lens.focal_length_mm = *values.focal_length_mm;
  lens.pixels_per_metre = values.pixels_per_metre.value_or(0);
  lens.sensor_width_mm = sensor_across(values, display);
  lens.focus_distance_units = *values.focus_distance_units;
  lens.focus_end_units = values.focus_end_units.value_or(0);
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
