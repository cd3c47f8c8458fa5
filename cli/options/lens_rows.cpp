#include "options/lens_rows.h"

namespace defray::cli {
namespace {

/// False where options win over everything that a camera can say.
bool is_camera_heard(const Given& given) {
  const bool has_optics = given("--focal-length") &&
                          (given("--fstop") || given("--aperture-diameter")) &&
                          (given("--sensor-width") || given("--pixel-scale"));
  return !(given("--focus") && (has_optics || given("--eye")));
}

}  // namespace

std::vector<OptionRow> lens_rows(CameraValues& v, const std::string& unit) {
  return {
      {"--focus",
       value(v.focus_distance_units),
       "Focus distance, planar, " + unit + "; inf is allowed",
       {.field = "focus_distance_units"}},
      {"--fstop", value(v.fstop), "f-number"},
      {"--aperture-diameter",
       value(v.aperture_diameter_mm),
       "mm, instead of --fstop; 0: pinhole",
       {.field = "aperture_diameter_mm"}},
      {"--focal-length", value(v.focal_length_mm), "mm", {.field = "focal_length_mm"}},
      {"--sensor-width",
       value(v.sensor_width_mm, fmt::format("{}", Lens().sensor_width_mm)),
       "mm across the display window",
       {.field = "sensor_width_mm"}},
  };
}

std::vector<OptionRow> camera_rows(std::string& file, std::string& focus_setting,
                                   const std::string& others) {
  return {
      {"--camera",
       value(file),
       "camera.json" + others + ": the lens. Options win over it",
       {.needs = {is_camera_heard,
                  "means nothing beside a focus and a whole lens: they win over all it says"}}},
      {"--focus-setting",
       value(focus_setting),
       "Which focus setting of camera.json",
       {.needs = {[&file](const Given&) { return !file.empty() && file != from_metadata; },
                  "goes with --camera FILE.json"}}},
  };
}

}  // namespace defray::cli
