// The lens of defray render.
#include <cmath>

#include "options/lens_rows.h"
#include "render/render_command.h"

namespace defray::cli {
namespace {

const WordTable<Eye> eye_words{{"retina", Eye::retina}, {"display", Eye::display}};
const WordTable<LensModel> model_words{{"cg", LensModel::cg}, {"breathing", LensModel::breathing}};

/// An eye says aperture, focal length and pixel scale.
bool is_eye_heard(const Given& given) {
  return !(given("--focal-length") && (given("--fstop") || given("--aperture-diameter")) &&
           (given("--sensor-width") || given("--pixel-scale")));
}

double above_zero(const char* option, double value) {
  if (value > 0 && !std::isinf(value)) return value;
  fail(ErrorKind::usage, "{} is {}: it must be a finite number above 0", option, value);
}

std::vector<OptionRow> eye_rows(EyeOptions& e) {
  const Needs display{[&e](const Given&) { return e.eye == Eye::display; },
                      "goes with --eye=display"};
  return {
      {"--eye",
       optional_word(e.eye, eye_words, "retina"),
       "An eye's lens: 4.6 mm, 17 mm, 28000 px/m; --eye=display: 4 mm, 24 mm, by a display",
       {.needs = {is_eye_heard,
                  "means nothing beside an aperture, a focal length and a sensor: "
                  "they win over all it says"}}},
      {"--display-distance",
       value(e.display_distance_m),
       "m, of --eye=display",
       {.needs = display}},
      {"--display-resolution",
       value(e.display_px_per_metre),
       "px per metre, of --eye=display",
       {.needs = display}},
  };
}

/// What the eye says; nothing without one.
CameraValues eye_of(const EyeOptions& e) {
  const double distance = above_zero("--display-distance", e.display_distance_m);
  const double resolution = above_zero("--display-resolution", e.display_px_per_metre);
  return e.eye ? eye_values(*e.eye, distance, resolution) : CameraValues{};
}

}  // namespace

OptionGroup lens_options(RenderCommand& job) {
  RenderSettings& s = job.settings;
  OptionGroup group{"Lens", lens_rows(s.camera, "scene units"), {.methods = lens_methods}};
  const auto add = [&](std::vector<OptionRow> rows) {
    group.rows.insert(group.rows.end(), rows.begin(), rows.end());
  };
  add({{"--pixel-scale",
        value(s.camera.pixels_per_metre),
        "Pixels per metre of image plane, instead of --sensor-width",
        {.field = "pixels_per_metre"}}});
  add(eye_rows(job.eye));
  add({{"--scale",
        value(s.camera.perceived_scale),
        "Make the scene look this much of its size: divides the aperture",
        {.field = "perceived_scale"}},
       {"--perceived-distance",
        value(s.camera.perceived_distance_m),
        "m; as --scale, so that the plane of focus seems this far away",
        {.field = "perceived_distance_m"}}});
  add(camera_rows(job.camera, job.focus_setting, ", or " + from_metadata + ", the image's own"));
  add({{"--lens-model", word(s.model, model_words),
        "cg: a renderer's thin lens; breathing: field of view follows focus"},
       {"--max-coc",
        parsed<double>(
            [&s](double px) {
              if (!(px > 0)) fail(ErrorKind::usage, "--max-coc is {} px: it must be above 0", px);
              s.max_coc_px = px;
            },
            "none"),
        "Limit of the CoC radius, px",
        {.field = "max_coc_px"}}});
  return group;
}

void finish_lens(RenderCommand& job) {
  RenderSettings& s = job.settings;
  s.camera_from_metadata = job.camera == from_metadata;
  const CameraValues typed = s.camera;
  const bool has_file = !job.camera.empty() && !s.camera_from_metadata;
  s.camera = has_file ? read_camera_json(job.camera, job.focus_setting, s.metres_per_unit)
                      : CameraValues{};
  s.camera = s.camera.overridden_by(eye_of(job.eye)).overridden_by(typed);
  if (!s.camera_from_metadata) make_lens(s.camera, s.metres_per_unit, s.model, s.max_coc_px);
}

}  // namespace defray::cli
