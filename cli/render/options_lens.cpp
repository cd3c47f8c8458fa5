// The lens of defray render.
#include <cmath>
#include <limits>

#include "image/sequence.h"
#include "lens/aperture.h"
#include "lens/camera.h"
#include "options/lens_rows.h"
#include "render/render_command.h"

namespace defray::cli {
namespace {

const WordTable<LensModel> model_words{{"cg", LensModel::cg}, {"breathing", LensModel::breathing}};

/// "2,4.5", or "2,4.5:1,3,6:24": what is kept sharp, of all frames or from frame to frame.
void set_range(RenderCommand& job, const std::string& text) {
  std::vector<std::string> parts = split(text, ',');
  const bool is_smooth = parts.size() > 2 && parts.back() == "smooth";
  if (is_smooth) parts.pop_back();
  if (parts.size() % 2 != 0) {
    fail(ErrorKind::usage,
         "--focus-range '{}': write its two ends as 2,4.5, or as 2,4.5:1,3,6:24 for 2 to 4.5 at "
         "frame 1 and 3 to 6 at frame 24",
         text);
  }
  std::vector<std::string> near, far;
  for (std::size_t i = 0; i < parts.size(); i += 2) {
    const std::size_t colon = parts[i + 1].find(':');
    near.push_back(parts[i] + (colon == std::string::npos ? "" : parts[i + 1].substr(colon)));
    far.push_back(parts[i + 1]);
  }
  const std::string ending = is_smooth ? ",smooth" : "";
  const auto set = [&](CameraField field, const std::vector<std::string>& numbers) {
    set_lens_number(number_of(job.settings.camera, field), &job.animated,
                    {"--focus-range", "scene units"}, join(numbers, ",") + ending);
  };
  set(&CameraValues::focus_distance_units, near);
  set(&CameraValues::focus_end_units, far);
}

std::vector<OptionRow> focus_rows(RenderCommand& job) {
  const auto alone = [](const Given& given) {
    return 1 == given("--focus") + given("--focus-at") + given("--focus-range");
  };
  const Needs no_other{alone,
                       "says what --focus does: give one of --focus, --focus-at, --focus-range"};
  return {
      {"--focus-at",
       parsed<std::string>([&job](const std::string& text) {
         job.settings.focus_at = parse_place("--focus-at", text);
       }),
       "Pixel x,y of the display window whose depth is the focus, the median of 5x5, frame by "
       "frame",
       {.field = "focus_at", .needs = no_other}},
      {"--focus-frame",
       value(job.focus_frame),
       "Take --focus-at's depth from this frame, for all",
       {.needs = {[](const Given& given) { return given("--focus-at"); }, "goes with --focus-at"}}},
      {"--focus-range",
       parsed<std::string>([&job](const std::string& text) { set_range(job, text); }),
       "near,far[:FRAME,...], scene units: what is kept sharp; outside, the blur of a focus on the "
       "nearer end",
       {.field = "focus_range", .needs = no_other}},
  };
}

}  // namespace

OptionGroup lens_options(RenderCommand& job) {
  RenderSettings& s = job.settings;
  OptionGroup group{
      "Lens", lens_rows(s.camera, "scene units", &job.animated), {.methods = lens_methods()}};
  const auto add = [&](std::vector<OptionRow> rows) {
    group.rows.insert(group.rows.end(), rows.begin(), rows.end());
  };
  add(sensor_rows(s.camera, &job.animated));
  add(focus_rows(job));
  add(eye_rows(job.eye, job.animated));
  add(scale_rows(s.camera, job.animated));
  add(camera_rows(job.camera, job.focus_setting, ", or " + from_metadata + ", the image's own"));
  add({{"--lens-model", word(s.model, model_words),
        "cg: a renderer's thin lens; breathing: field of view follows focus"}});
  group.rows.push_back(max_coc_row(s.max_coc_px, job.animated));
  return group;
}

namespace {

/// The camera file of a frame, under the eye; empty where there is none.
CameraValues camera_at(const RenderCommand& job, const EyeOptions& eye, std::optional<int> frame) {
  const bool has_file = !job.camera.empty() && job.camera != from_metadata;
  if (!has_file) return eye_of(eye);
  const std::string path = frame ? frame_path(job.camera, *frame) : job.camera;
  return read_camera_json(path, job.focus_setting, job.settings.metres_per_unit)
      .overridden_by(eye_of(eye));
}

/// Throws what is wrong with a lens of which the picture tells no part.
void check_lens(const RenderSettings& s) {
  if (s.camera_from_metadata) return;
  CameraValues camera = s.camera;
  if (s.focus_at) {
    camera.focus_distance_units = std::numeric_limits<double>::infinity();
    camera.perceived_distance_m.reset();
  }
  make_lens(camera, s.metres_per_unit, s.model, s.max_coc_px);
}

}  // namespace

RenderSettings settings_at(const RenderCommand& job, std::optional<int> frame) {
  RenderSettings s = job.settings;
  if (!has_lens(s.method.method)) return s;
  std::optional<ChainSettings>& chain = s.method.chain;
  FrameLens lens{s.camera, chain ? chain->aperture : Aperture(), job.eye, s.max_coc_px};
  for (const AnimatedValue& value : job.animated) {
    if (!frame) {
      fail(ErrorKind::usage, "{} changes over frames, the input {} has none", value.option,
           job.paths.input);
    }
    value.set(lens, value.curve.at(*frame));
  }
  s.camera = camera_at(job, lens.eye, frame).overridden_by(lens.camera);
  const std::string of_eye = note_on_eye(lens.eye, lens.camera);
  if (!of_eye.empty()) s.camera.notes.push_back(of_eye);
  s.max_coc_px = lens.max_coc_px;
  if (chain) {
    validate(lens.aperture);
    chain->aperture = lens.aperture;
  }
  return s;
}

void check_lens(const RenderCommand& job, const std::vector<std::optional<int>>& frames) {
  if (!has_lens(job.settings.method.method)) return;
  // A camera file a frame may be missing, or wrong: that frame's error.
  const bool is_of_frames = frames.front() && has_frame_pattern(job.camera);
  const bool is_constant = job.animated.empty();
  for (const std::optional<int>& frame : frames) {
    if (!is_of_frames) check_lens(settings_at(job, frame));
    if (is_constant) break;
  }
}

}  // namespace defray::cli
