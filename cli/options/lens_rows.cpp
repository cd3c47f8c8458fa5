#include "options/lens_rows.h"

#include <cmath>

#include "base/error.h"

namespace defray::cli {
namespace {

const WordTable<Eye> eye_words{{"retina", Eye::retina}, {"display", Eye::display}};
const WordTable<SensorFit> fit_words{{"auto", SensorFit::longer},
                                     {"horizontal", SensorFit::horizontal},
                                     {"vertical", SensorFit::vertical}};

double above_zero(const char* option, double value) {
  if (value > 0 && !std::isinf(value)) return value;
  fail(ErrorKind::usage, "{} is {}: it must be a finite number above 0", option, value);
}

double coc_limit(double px) {
  if (!(px > 0)) fail(ErrorKind::usage, "--max-coc is {} px: it must be above 0", px);
  return px;
}

}  // namespace

bool has_optics(const Given& given) {
  return given("--focal-length") && (given("--fstop") || given("--aperture-diameter")) &&
         (given("--sensor-width") || given("--sensor-height") || given("--fov") ||
          given("--pixel-scale"));
}

bool is_camera_heard(const Given& given) {
  const bool has_focus = given("--focus") || given("--focus-at") || given("--focus-range");
  return !(has_focus && (has_optics(given) || given("--eye")));
}

LensNumber number_of(CameraValues& camera, CameraField field) {
  return {[&camera, field](double v) { camera.*field = v; },
          [field](FrameLens& lens, double v) { lens.camera.*field = v; }};
}

void set_lens_number(const LensNumber& number, AnimatedLens* animated, const OptionText& option,
                     const std::string& text) {
  Curve curve(option, text);
  if (curve.is_constant()) {
    number.of_all(curve.at(0));
  } else {
    animated->push_back({option.name, std::move(curve), number.of_frame});
  }
}

OptionValue lens_value(LensNumber number, AnimatedLens* animated, std::string default_text) {
  const auto read = std::make_shared<std::string>();
  return {[read](CLI::App& c, const std::string& name) {
            return c.add_option(name, *read)->type_name("NUMBER[:FRAME,...]");
          },
          [read, number = std::move(number), animated](const OptionText& option) {
            set_lens_number(number, animated, option, *read);
          },
          std::move(default_text)};
}

OptionValue lens_value(CameraValues& camera, CameraField field, AnimatedLens* animated,
                       std::string default_text) {
  if (!animated) return value(camera.*field, std::move(default_text));
  return lens_value(number_of(camera, field), animated, std::move(default_text));
}

std::vector<OptionRow> lens_rows(CameraValues& v, const std::string& unit, AnimatedLens* animated) {
  return {
      {"--focus",
       lens_value(v, &CameraValues::focus_distance_units, animated),
       "Focus distance, planar, " + unit + "; inf is allowed",
       {.field = "focus_distance_units"}},
      {"--fstop", lens_value(v, &CameraValues::fstop, animated), "f-number"},
      {"--aperture-diameter",
       lens_value(v, &CameraValues::aperture_diameter_mm, animated),
       "mm, instead of --fstop; 0: pinhole",
       {.field = "aperture_diameter_mm"}},
      {"--focal-length",
       lens_value(v, &CameraValues::focal_length_mm, animated),
       "mm",
       {.field = "focal_length_mm"}},
      {"--sensor-width",
       lens_value(v, &CameraValues::sensor_width_mm, animated,
                  fmt::format("{}", Lens().sensor_width_mm)),
       "mm across the display window",
       {.field = "sensor_width_mm"}},
  };
}

std::vector<OptionRow> sensor_rows(CameraValues& v, AnimatedLens* animated) {
  return {
      {"--sensor-height",
       lens_value(v, &CameraValues::sensor_height_mm, animated),
       "mm over the display window, instead of --sensor-width",
       {.field = "sensor_height_mm"}},
      {"--fov",
       lens_value(v, &CameraValues::fov_deg, animated),
       "Degrees that the picture spans, instead of a sensor",
       {.field = "fov_deg"}},
      {"--sensor-fit",
       word<SensorFit>([&v](SensorFit fit) { v.fit = fit; }, fit_words, ""),
       "Which side the sensor or --fov spans: horizontal (default), vertical, or auto, the longer "
       "(with --sensor-width on either, as Blender has it)",
       {.field = "fit"}},
      {"--pixel-scale",
       lens_value(v, &CameraValues::pixels_per_metre, animated),
       "Pixels per metre of image plane, instead of --sensor-width",
       {.field = "pixels_per_metre"}},
  };
}

std::vector<OptionRow> scale_rows(CameraValues& v, AnimatedLens& animated) {
  return {{"--scale",
           lens_value(v, &CameraValues::perceived_scale, &animated),
           "Make the scene look this much of its size: divides the aperture",
           {.field = "perceived_scale"}},
          {"--perceived-distance",
           lens_value(v, &CameraValues::perceived_distance_m, &animated),
           "m; as --scale, so that the plane of focus seems this far away",
           {.field = "perceived_distance_m"}}};
}

std::vector<OptionRow> eye_rows(EyeOptions& e, AnimatedLens& animated) {
  const auto number = [&](double EyeOptions::*field) {
    return lens_value({[&e, field](double v) { e.*field = v; },
                       [field](FrameLens& lens, double v) { lens.eye.*field = v; }},
                      &animated, fmt::format("{}", e.*field));
  };
  const Needs display{[&e](const Given&) { return e.eye == Eye::display; },
                      "goes with --eye=display"};
  return {
      {"--eye",
       optional_word(e.eye, eye_words, "retina"),
       "An eye's lens: 4.6 mm, 17 mm, 28000 px/m; --eye=display: 4 mm, 24 mm, by a display",
       {.needs = {[](const Given& given) { return !has_optics(given); },
                  "means nothing beside an aperture, a focal length and a sensor: "
                  "they win over all it says"}}},
      {"--display-distance",
       number(&EyeOptions::display_distance_m),
       "m, of --eye=display",
       {.needs = display}},
      {"--display-resolution",
       number(&EyeOptions::display_px_per_metre),
       "px per metre, of --eye=display",
       {.needs = display}},
  };
}

CameraValues eye_of(const EyeOptions& e) {
  const double distance = above_zero("--display-distance", e.display_distance_m);
  const double resolution = above_zero("--display-resolution", e.display_px_per_metre);
  return e.eye ? eye_values(*e.eye, distance, resolution) : CameraValues{};
}

std::string note_on_eye(const EyeOptions& e, const CameraValues& stated) {
  const bool has_aperture = stated.fstop || stated.aperture_diameter_mm;
  if (!e.eye || !stated.focal_length_mm || !has_aperture) return "";
  return fmt::format(
      "of --eye only its {:g} px per metre are used: the aperture and the focal length given "
      "beside it win",
      eye_of(e).pixels_per_metre.value_or(0));
}

OptionRow max_coc_row(double& max_coc_px, AnimatedLens& animated) {
  return {"--max-coc",
          lens_value({[&max_coc_px](double px) { max_coc_px = coc_limit(px); },
                      [](FrameLens& lens, double px) { lens.max_coc_px = coc_limit(px); }},
                     &animated, "none"),
          "Limit of the CoC radius, px",
          {.field = "max_coc_px"}};
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
