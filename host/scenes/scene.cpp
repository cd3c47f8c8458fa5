#include "scenes/scene.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "scenes/builtin/builtin.h"

namespace defray {
namespace {

struct Builtin {
  SceneInfo info;
  Scene (*make)(int width, int height, int frame);
};

/// A scene that does not move.
template <Scene (*make)(int width, int height)>
Scene still(int width, int height, int) {
  return make(width, height);
}

const std::vector<Builtin>& builtins() {
  static const std::vector<Builtin> all = {
      {{"plate1", "Shinya's Plate 1: a thin dark rectangle in focus before a plaid, a near ball"},
       still<make_plate1>},
      {{"plate2", "Shinya's Plate 2: objects 3, 5 and 17 m away on a floor, f/R = 1"},
       [](int width, int height, int) { return make_plate2(width, height, 1); }},
      {{"blocks-lake", "Glatzel & Wilhelm's block world: the lake, as the eye sees it and tiny"},
       still<make_blocks_lake>},
      {{"blocks-forest", "the same world: the forest"}, still<make_blocks_forest>},
      {{"fence", "near bars before a brick wall: what hides behind an out-of-focus edge"},
       still<make_fence>},
      {{"spheres", "balls at many depths on a checkered floor, with small bright lamps"},
       still<make_spheres>},
      {{"points", "bright points (HDR) by night, near to far"}, still<make_points>},
      {{"impulses", "one bright pixel each at 63 depths: every circle of confusion, one by one"},
       still<make_impulses>},
      {{"slanted", "a textured plane slanting through the plane of focus"}, still<make_slanted>},
      {{"lines", "lines 1 to 3 pixels wide before, in and behind the plane of focus"},
       still<make_lines>},
      {{"highlights", "small lights up to 5000 times white, CoC 0.3 to 128 px, some half hidden"},
       still<make_highlights>},
      {{"cutout", "flat shapes at many depths before nothing: what alpha does"},
       still<make_cutout>},
      {{"drift", "a fence drifting before a portrait", drift_frames}, make_drift},
      {{"garden", "grass swaying, and lamps that pass behind a near post", garden_frames},
       make_garden},
  };
  return all;
}

const Builtin& find_builtin(const std::string& name) {
  for (const Builtin& builtin : builtins()) {
    if (builtin.info.name == name) return builtin;
  }
  fail(ErrorKind::usage, "{}", not_known("scene", name, scene_names()));
}

nlohmann::ordered_json setting_json(const Scene& scene, const FocusSetting& setting,
                                    const std::map<std::string, Comparison>& noise) {
  nlohmann::ordered_json json = {{"focus_distance_m", setting.focus_distance_units},
                                 {"aperture_diameter_m", setting.aperture_diameter_mm / 1000},
                                 {"f_stop", scene.focal_length_mm / setting.aperture_diameter_mm}};
  if (const auto found = noise.find(setting.name); found != noise.end()) {
    json["truth_noise_psnr_srgb_db"] = found->second.psnr_srgb_db;
    json["truth_noise_psnr_linear_db"] = found->second.psnr_linear_db;
  }
  return json;
}

}  // namespace

const std::vector<SceneInfo>& scene_list() {
  static const std::vector<SceneInfo> list = [] {
    std::vector<SceneInfo> infos;
    for (const Builtin& builtin : builtins()) infos.push_back(builtin.info);
    return infos;
  }();
  return list;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneInfo& info : scene_list()) names.push_back(info.name);
  return names;
}

const SceneInfo& scene_info(const std::string& name) { return find_builtin(name).info; }

Scene make_scene(const std::string& name, int width, int height, int frame) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384) {
    fail(ErrorKind::usage, "scene size {}x{}: allowed are 1 to 16384 a side", width, height);
  }
  const Builtin& builtin = find_builtin(name);
  if (frame < 1 || frame > builtin.info.frames) {
    fail(ErrorKind::usage, "scene '{}' has no frame {}: allowed are 1 to {}", name, frame,
         builtin.info.frames);
  }
  Scene scene = builtin.make(width, height, frame);
  scene.name = name;
  return scene;
}

const FocusSetting& find_setting(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const FocusSetting& setting : scene.settings) {
    if (setting.name == name) return setting;
    names.push_back(setting.name);
  }
  fail(ErrorKind::usage, "scene '{}' has no focus setting '{}'.{} It has: {}", scene.name, name,
       did_you_mean(name, names), join(names, " "));
}

Lens lens_of(const Scene& scene, const FocusSetting& setting) {
  Lens lens;
  lens.focal_length_mm = scene.focal_length_mm;
  lens.sensor_width_mm = scene.sensor_width_mm;
  lens.aperture_diameter_mm = setting.aperture_diameter_mm;
  lens.focus_distance_units = setting.focus_distance_units;
  return lens;
}

double pixel_focal_length(const Scene& scene) {
  return scene.width * scene.focal_length_mm / scene.sensor_width_mm;
}

std::string camera_json(const Scene& scene, const std::map<std::string, Comparison>& noise) {
  nlohmann::ordered_json settings;
  for (const FocusSetting& setting : scene.settings) {
    settings[setting.name] = setting_json(scene, setting, noise);
  }
  const nlohmann::ordered_json root = {{"scene", scene.name},
                                       {"width", scene.width},
                                       {"height", scene.height},
                                       {"focal_length_mm", scene.focal_length_mm},
                                       {"sensor_width_mm", scene.sensor_width_mm},
                                       {"sensor_fit", "horizontal"},
                                       {"pixel_focal_px", pixel_focal_length(scene)},
                                       {"focus_settings", settings}};
  return root.dump(2) + "\n";
}

}  // namespace defray
