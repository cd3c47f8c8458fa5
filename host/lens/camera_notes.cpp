#include <fmt/format.h>

#include "base/error.h"
#include "lens/camera.h"

namespace defray {
namespace {

/// What real lenses have, with a factor of ten to both sides: phones to telescopes.
struct Usual {
  const char* what;
  const char* unit;
  double smallest, largest;
};
constexpr Usual usual_focal_length{"focal length", " mm", 0.15, 20000};
constexpr Usual usual_f_number{"f-number", "", 0.07, 640};
constexpr Usual usual_sensor{"sensor", " mm", 0.3, 700};

void note_unusual(const Usual& usual, const std::optional<double>& value,
                  std::vector<std::string>& notes) {
  if (!value || (*value >= usual.smallest && *value <= usual.largest)) return;
  notes.push_back(
      fmt::format("{} {:g}{} is ten times off any real one ({:g} to {:g}): is {} right?",
                  usual.what, *value, usual.unit, usual.smallest * 10, usual.largest / 10,
                  usual.unit[0] == '\0' ? "it" : "the unit"));
}

}  // namespace

std::vector<std::string> notes_on_extremes(const CameraValues& v) {
  std::vector<std::string> notes;
  note_unusual(usual_focal_length, v.focal_length_mm, notes);
  note_unusual(usual_sensor, v.sensor_width_mm, notes);
  note_unusual(usual_sensor, v.sensor_height_mm, notes);
  const bool is_pinhole = v.aperture_diameter_mm == 0.0;
  if (v.fstop) {
    note_unusual(usual_f_number, v.fstop, notes);
  } else if (v.focal_length_mm && v.aperture_diameter_mm && !is_pinhole) {
    note_unusual(usual_f_number, *v.focal_length_mm / *v.aperture_diameter_mm, notes);
  }
  return notes;
}

std::string note_on_upright(const CameraValues& v, const Window& display) {
  const bool is_told = v.fit || v.sensor_height_mm || v.fov_deg || v.pixels_per_metre;
  if (is_told || v.aperture_diameter_mm == 0.0 || display.height <= display.width) return "";
  const double width = v.sensor_width_mm.value_or(Lens().sensor_width_mm);
  return fmt::format(
      "the frame is upright, its width has the sensor's {:g} mm: with {} auto, as Blender's Auto, "
      "it would have {:.6g} mm; horizontal says that it is so",
      width, field("fit"), width * display.width / display.height);
}

}  // namespace defray
