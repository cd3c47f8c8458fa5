#include "truth/places.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "image/channels.h"
#include "lens/camera.h"
#include "lens/depth.h"

namespace defray::perf {
namespace {

std::vector<Plane> read_colour(const ImageFile& file) {
  const ColourChoice choice = choose_colour(file.path(), file.parts(), {});
  std::vector<Plane> planes;
  for (std::size_t c = 0; c < 3; ++c) planes.push_back(file.plane(choice.part, choice.channels[c]));
  return planes;
}

/// One focus setting of a scene in a folder.
MeasuredPlace read_place(const Bench& bench, const std::filesystem::path& folder,
                         const std::string& setting) {
  const std::string path = folder / "pinhole.exr";
  const ImageFile file = ImageFile::read(path);
  const ChannelName depth = choose_depth(path, file.parts(), {}, {});
  const PartInfo& part = file.parts()[static_cast<std::size_t>(depth.part)];
  Subject s;
  s.scene.name = folder.filename();
  s.scene.width = part.data.width;
  s.scene.height = part.data.height;
  s.lens = make_lens(read_camera_json(folder / "camera.json", setting, 1), 1, LensModel::cg, 0);
  s.pinhole.colour = read_colour(file);
  s.pinhole.depth = file.plane(depth.part, depth.channel);
  convert_depth(s.pinhole.depth, {}, part.data, part.display,
                pixel_focal_length(s.lens, part.display.width), path);
  s.coc = bench.backend.coc(s.lens, s.scene.width, s.pinhole.depth);
  const std::string name = s.scene.name + " " + setting;
  return {name, std::move(s), read_colour(ImageFile::read(folder / ("truth_" + setting + ".exr")))};
}

}  // namespace

void check_scenes(const std::string& scenes) {
  if (!scenes.empty() && !std::filesystem::is_directory(scenes)) {
    fail(ErrorKind::input, "{}: no such folder", scenes);
  }
}

std::vector<MeasuredPlace> read_places(const Bench& bench) {
  std::vector<std::filesystem::path> truths;
  if (bench.scenes.empty()) return {};
  for (const auto& scene : std::filesystem::directory_iterator(bench.scenes)) {
    if (!scene.is_directory()) continue;
    for (const auto& file : std::filesystem::directory_iterator(scene)) {
      if (file.path().filename().string().starts_with("truth_")) truths.push_back(file.path());
    }
  }
  std::sort(truths.begin(), truths.end());
  std::vector<MeasuredPlace> places;
  for (const auto& truth : truths) {
    const std::string setting = truth.stem().string().substr(std::string("truth_").size());
    places.push_back(read_place(bench, truth.parent_path(), setting));
  }
  return places;
}

}  // namespace defray::perf
