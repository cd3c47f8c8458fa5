// defray scene: writes a built-in scene with its truth.
#include "scenes/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "commands.h"
#include "error.h"
#include "image/image_file.h"
#include "image/safe_output.h"
#include "progress.h"

namespace defray::cli {
namespace {

struct Options {
  std::string name, folder;
  int width = 640, height = 480, truth_samples = 256;
  std::uint32_t seed = 1;
};

void write_planes(const std::string& path, const std::vector<std::string>& channels,
                  const std::vector<Plane>& planes, const Scene& scene) {
  const ImageFile file =
      ImageFile::from_planes(channels, planes, scene.width, scene.height, Sample::single_float);
  write_safely(path, [&](const std::string& name) { file.write(name); });
}

int run(const Options& o) {
  const Scene scene = make_scene(o.name, o.width, o.height);
  std::error_code error;
  std::filesystem::create_directories(o.folder, error);
  const std::string pinhole = o.folder + "/pinhole.exr", truth = o.folder + "/truth.exr";
  const std::string camera = o.folder + "/camera.json";
  check_can_write(pinhole);

  ScenePicture picture = render_pinhole(scene);
  picture.colour.push_back(std::move(picture.depth));
  write_planes(pinhole, {"R", "G", "B", "Z"}, picture.colour, scene);
  {
    ProgressBar bar(1, "truth", true);
    const ScenePicture exact =
        render_truth(scene, o.truth_samples, o.seed, [&](double share) { bar.update(0, share); });
    write_planes(truth, {"R", "G", "B"}, exact.colour, scene);
  }
  write_safely(camera, [&](const std::string& name) {
    std::ofstream stream(name);
    stream << camera_json(scene);
    if (!stream.flush()) fail(ExitCode::output, "{}: cannot write", name);
  });
  fmt::print("{}\n{}\n{}\n", pinhole, truth, camera);
  return 0;
}

}  // namespace

Run add_scene(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "scene",
      "Write a built-in scene: pinhole.exr (R G B Z), truth.exr through a real lens, "
      "camera.json");
  auto o = std::make_shared<Options>();
  command->add_option("name", o->name, "plate1: Shinya's Plate 1, a thin dark rectangle in focus")
      ->required();
  command->add_option("-o,--output", o->folder, "Folder, made if missing")->required();
  command->add_option("--width", o->width, "Pixels");
  command->add_option("--height", o->height, "Pixels");
  command->add_option("--truth-samples", o->truth_samples, "Lens rays a pixel for the truth");
  command->add_option("--seed", o->seed, "Seed of the truth's samples");
  command->footer("Example: defray scene plate1 -o plate1 --truth-samples 1024");
  return [o] { return run(*o); };
}

}  // namespace defray::cli
