// defray scene: writes a built-in scene with its truth.
#include "scenes/scene.h"

#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "error.h"
#include "image/image_file.h"
#include "image/safe_output.h"
#include "options.h"
#include "progress.h"
#include "scenes/render.h"

namespace defray::cli {
namespace {

struct Options {
  std::string name, folder, setting;
  int width = 640, height = 480, truth_samples = 256;
  std::uint32_t seed = 1;
  bool hidden = false;
};

void write_planes(const std::string& path, const std::vector<std::string>& channels,
                  const std::vector<Plane>& planes, const Scene& scene) {
  const ImageFile file =
      ImageFile::from_planes(channels, planes, scene.width, scene.height, Sample::single_float);
  write_safely(path, [&](const std::string& name) { file.write(name); });
  fmt::print("{}\n", path);
}

void write_picture(const std::string& path, ScenePicture picture, const Scene& scene) {
  picture.colour.push_back(std::move(picture.depth));
  write_planes(path, {"R", "G", "B", "Z"}, picture.colour, scene);
}

std::string truth_path(const Options& o, const Scene& scene, const FocusSetting& setting) {
  if (scene.settings.size() == 1) return o.folder + "/truth.exr";
  return o.folder + "/truth_" + setting.name + ".exr";
}

void report_noise(const Comparison& noise) {
  fmt::print(
      "  its halves are {:.2f} dB apart sRGB-encoded, {:.2f} dB linear; their mean is about "
      "6 dB better\n",
      noise.psnr_srgb_db, noise.psnr_linear_db);
}

/// Writes the truth of each setting asked for; how noisy they are, by setting.
std::map<std::string, Comparison> write_truths(const Options& o, const Scene& scene,
                                               const std::vector<FocusSetting>& settings) {
  std::map<std::string, Comparison> noise;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    ProgressBar bar(settings.size(), "truths", true);
    const Truth truth = render_truth(scene, lens_of(scene, settings[i]), o.truth_samples, o.seed,
                                     [&](double share) { bar.update(i, share); });
    bar.clear();
    write_planes(truth_path(o, scene, settings[i]), {"R", "G", "B"}, truth.colour, scene);
    if (!truth.noise) continue;
    noise[settings[i].name] = *truth.noise;
    report_noise(*truth.noise);
  }
  return noise;
}

int run(const Options& o) {
  check_truth_samples(o.truth_samples);  // before anything is written
  const Scene scene = make_scene(o.name, o.width, o.height);
  std::vector<FocusSetting> settings = scene.settings;
  if (!o.setting.empty()) settings = {find_setting(scene, o.setting)};
  std::error_code error;
  std::filesystem::create_directories(o.folder, error);
  check_can_write(o.folder + "/pinhole.exr");

  write_picture(o.folder + "/pinhole.exr", render_pinhole(scene), scene);
  if (o.hidden) write_picture(o.folder + "/hidden.exr", render_hidden(scene), scene);
  const auto noise = write_truths(o, scene, settings);
  const std::string camera = o.folder + "/camera.json";
  write_text(camera, camera_json(scene, noise));
  fmt::print("{}\n", camera);
  return 0;
}

std::string list_of_scenes() {
  std::string text = "Scenes:\n";
  for (const SceneInfo& info : scene_list()) {
    text += fmt::format("  {:14} {}\n", info.name, info.about);
  }
  return text;
}

}  // namespace

Run add_scene(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "scene",
      "Write a built-in scene: pinhole.exr (R G B Z), the truth through a real lens for each focus "
      "setting (truth.exr, or truth_SETTING.exr where there are several), camera.json");
  auto o = std::make_shared<Options>();
  command->add_option("name", o->name, "One of the scenes below")->required();
  command->add_option("-o,--output", o->folder, "Folder, made if missing")
      ->required()
      ->check(no_empty_path);
  command->add_option("--width", o->width, "Pixels");
  command->add_option("--height", o->height, "Pixels");
  command->add_option("--setting", o->setting, "The truth of this focus setting only");
  command->add_option("--truth-samples", o->truth_samples, "Lens rays a pixel for the truth");
  command->add_option("--seed", o->seed, "Seed of the truth's samples");
  command->add_flag("--hidden", o->hidden,
                    "Also hidden.exr (R G B Z): what lies next behind the first surface");
  command->footer(list_of_scenes() + "Example: defray scene plate1 -o plate1 --truth-samples 1024");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
