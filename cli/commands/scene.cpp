// defray scene: writes a built-in scene with its truth.
#include "scenes/scene.h"

#include <fmt/format.h>

#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "commands.h"
#include "image/image_file.h"
#include "image/safe_output.h"
#include "image/sequence.h"
#include "options/option_value.h"
#include "progress.h"
#include "scenes/tracing/render.h"

namespace defray::cli {
namespace {

struct SceneOptions {
  std::string name, folder, setting, frames;
  int width = 640, height = 480, truth_samples = 256;
  PinholeSampling pinhole{16, false};  ///< Anti-aliased, as productions have it.
  std::uint32_t seed = 1;
  bool hidden = false, alpha = false, quiet = false;
};

/// How noisy truths are, by setting; of several frames, the noisiest.
using Noise = std::map<std::string, Comparison>;

/// A frame to be written; no number where the picture is the only one.
using FrameNumber = std::optional<int>;

/// "truth" -> "FOLDER/truth.exr", or "FOLDER/truth.0007.exr".
std::string path_of(const SceneOptions& o, const std::string& name, FrameNumber frame) {
  if (!frame) return o.folder + "/" + name + ".exr";
  return frame_path(o.folder + "/" + name + ".####.exr", *frame);
}

void write_planes(const SceneOptions& o, const std::string& path,
                  const std::vector<std::string>& channels, const std::vector<Plane>& planes,
                  const Scene& scene) {
  const ImageFile file =
      ImageFile::from_planes(channels, planes, scene.width, scene.height, Sample::single_float);
  write_safely(path, [&](const std::string& name) { file.write(name); });
  if (!o.quiet) fmt::print("{}\n", path);
}

void write_picture(const SceneOptions& o, const std::string& path, ScenePicture picture,
                   const Scene& scene) {
  std::vector<std::string> channels{"R", "G", "B"};
  std::vector<Plane> planes = std::move(picture.colour);
  if (o.alpha) {
    channels.push_back("A");
    planes.push_back(std::move(picture.alpha));
  }
  channels.push_back("Z");
  planes.push_back(std::move(picture.depth));
  write_planes(o, path, channels, planes, scene);
}

void write_truth(const SceneOptions& o, const std::string& path, const Truth& truth,
                 const Scene& scene) {
  std::vector<std::string> channels{"R", "G", "B"};
  std::vector<Plane> planes = truth.colour;
  if (o.alpha) {
    channels.push_back("A");
    planes.push_back(truth.alpha);
  }
  write_planes(o, path, channels, planes, scene);
}

void report_noise(const SceneOptions& o, const Truth& truth) {
  fmt::print(
      "  its halves are {:.2f} dB apart sRGB-encoded, {:.2f} dB linear; their mean is about "
      "6 dB better\n",
      truth.noise->psnr_srgb_db, truth.noise->psnr_linear_db);
  if (o.alpha) {
    fmt::print("  its alpha is about {:.2g} off (RMS), {:.2g} at worst\n", truth.alpha_noise_rms,
               truth.alpha_noise_worst);
  }
}

std::string truth_name(const Scene& scene, const std::string& setting) {
  return scene.settings.size() == 1 ? "truth" : "truth_" + setting;
}

/// Writes the truth of each setting asked for.
void write_truths(const SceneOptions& o, const Scene& scene,
                  const std::vector<FocusSetting>& settings, FrameNumber frame, Noise& noise) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    ProgressBar bar(settings.size(), "truths", !o.quiet);
    const Truth truth = render_truth(scene, lens_of(scene, settings[i]), o.truth_samples, o.seed,
                                     [&](double share) { bar.update(i, share); });
    bar.clear();
    const std::string& setting = settings[i].name;
    write_truth(o, path_of(o, truth_name(scene, setting), frame), truth, scene);
    if (!truth.noise) continue;
    const auto [known, is_new] = noise.insert({setting, *truth.noise});
    if (!is_new && truth.noise->psnr_srgb_db < known->second.psnr_srgb_db) {
      known->second = *truth.noise;
    }
    if (!o.quiet) report_noise(o, truth);
  }
}

Scene scene_of(const SceneOptions& o, FrameNumber frame) {
  Scene scene = make_scene(o.name, o.width, o.height, frame.value_or(1));
  if (o.alpha) scene.background = {};
  return scene;
}

std::vector<FocusSetting> settings_of(const SceneOptions& o, const Scene& scene) {
  if (o.setting.empty()) return scene.settings;
  return {find_setting(scene, o.setting)};
}

void write_frame(const SceneOptions& o, FrameNumber frame, Noise& noise) {
  const Scene scene = scene_of(o, frame);
  write_picture(o, path_of(o, "pinhole", frame), render_pinhole(scene, o.pinhole), scene);
  if (o.hidden) write_picture(o, path_of(o, "hidden", frame), render_hidden(scene), scene);
  write_truths(o, scene, settings_of(o, scene), frame, noise);
}

std::vector<FrameNumber> frames_of(const SceneOptions& o) {
  if (o.frames.empty()) return {std::nullopt};
  if (scene_info(o.name).frames == 1) {
    fail(ErrorKind::usage, "--frames: scene '{}' does not move", o.name);
  }
  std::vector<FrameNumber> frames;
  for (const int frame : parse_frames(o.frames)) frames.push_back(frame);
  return frames;
}

std::string camera_path(const SceneOptions& o) { return o.folder + "/camera.json"; }

/// Throws Error(output) before anything is rendered.
void check_places(const SceneOptions& o, const std::vector<FrameNumber>& frames) {
  check_can_write(camera_path(o));
  for (const FrameNumber frame : frames) {
    const Scene scene = scene_of(o, frame);
    check_can_write(path_of(o, "pinhole", frame));
    if (o.hidden) check_can_write(path_of(o, "hidden", frame));
    for (const FocusSetting& setting : settings_of(o, scene)) {
      check_can_write(path_of(o, truth_name(scene, setting.name), frame));
    }
  }
}

/// Throws Error(usage) before anything is written.
void check(const SceneOptions& o, const std::vector<FrameNumber>& frames) {
  check_samples("truth_samples", o.truth_samples);
  check_samples("pinhole_samples", o.pinhole.samples);
  if (o.pinhole.averages_depth && o.pinhole.samples == 1) {
    fail(ErrorKind::usage,
         "--antialiased-depth with --pinhole-samples 1: of one ray there is no mean");
  }
  for (const FrameNumber frame : frames) settings_of(o, scene_of(o, frame));
}

int run(const SceneOptions& o) {
  const std::vector<FrameNumber> frames = frames_of(o);
  check(o, frames);
  create_folder(o.folder);
  check_places(o, frames);
  Noise noise;
  for (const FrameNumber frame : frames) write_frame(o, frame, noise);
  const std::string camera = camera_path(o);
  write_text(camera, camera_json(scene_of(o, frames.front()), noise));
  if (!o.quiet) fmt::print("{}\n", camera);
  return 0;
}

std::vector<std::string> names_of_scenes() {
  std::vector<std::string> names;
  for (const SceneInfo& info : scene_list()) names.push_back(info.name);
  return names;
}

std::string list_of_scenes() {
  std::string text = "Scenes:\n";
  for (const SceneInfo& info : scene_list()) {
    const std::string moves = info.frames > 1 ? fmt::format(" (--frames 1-{})", info.frames) : "";
    text += fmt::format("  {:14} {}{}\n", info.name, info.about, moves);
  }
  return text;
}

}  // namespace

Run add_scene(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "scene",
      "Write a built-in scene: pinhole.exr (R G B Z), the truth through a real lens for each focus "
      "setting (truth.exr, or truth_SETTING.exr where there are several), camera.json");
  auto o = std::make_shared<SceneOptions>();
  command->add_option("name", o->name, "One of " + join(names_of_scenes(), ", "))->required();
  command->add_option("-o,--output", o->folder, "Folder, made if missing")->required();
  command->add_option("--width", o->width, "Pixels");
  command->add_option("--height", o->height, "Pixels");
  command->add_option("--focus-setting", o->setting, "The truth of this focus setting only");
  command->add_option("--truth-samples", o->truth_samples, "Lens rays a pixel for the truth");
  command->add_option("--frames", o->frames,
                      "Frames of a scene that moves, as files like pinhole.0001.exr: 1-24, 1,5,9 "
                      "or 1-24x2; without it, the first");
  command->add_option(
      "--pinhole-samples", o->pinhole.samples,
      "Rays a pixel for the pinhole picture's colour, which anti-alias it; depth stays its "
      "centre's");
  command->add_flag("--antialiased-depth", o->pinhole.averages_depth,
                    "Depth is the mean over those rays too: wrong at every edge, as some renderers "
                    "write it");
  command->add_flag("--alpha", o->alpha,
                    "Also channel A: colour premultiplied, nothing where nothing is hit");
  command->add_option("--seed", o->seed, "Seed of the truth's samples");
  command->add_flag("--hidden", o->hidden,
                    "Also hidden.exr (R G B Z): what lies next behind the first surface");
  command->add_flag("-q,--quiet", o->quiet, quiet_help);
  command->footer(list_of_scenes() + "Example: defray scene plate1 -o plate1 --truth-samples 1024");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
