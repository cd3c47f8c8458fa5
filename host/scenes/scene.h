#pragma once
// The built-in analytic scenes: what is in them, and how the camera looks at them.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lens/lens.h"
#include "measure/metrics.h"
#include "scenes/geometry/primitive.h"

namespace defray {

/// One way to focus a scene's camera.
struct FocusSetting {
  std::string name;
  double focus_distance_units = 0;  ///< Planar.
  double aperture_diameter_mm = 0;
};

/// A sun with sharp shadows, and light from all around.
struct Light {
  Vec3 to_sun{0, 0, 0};  ///< Unit length; all zero: no light, colours are shown as they are.
  Vec3 sun;              ///< What a surface that faces the sun gets.
  Vec3 sky, ground;      ///< What a surface that faces up or down gets.
  Vec3 up{0, -1, 0};     ///< Unit length.
};

struct Scene {
  std::string name;
  int width = 0, height = 0;
  double focal_length_mm = 50, sensor_width_mm = 36;
  std::vector<FocusSetting> settings;
  std::vector<std::unique_ptr<Primitive>> primitives;
  Light light;
  /// Colour where a ray of this direction hits nothing; empty: black.
  std::function<Vec3(const Vec3& direction)> background;
};

/// A name that make_scene knows, and a line about it.
struct SceneInfo {
  std::string name, about;
  int frames = 1;  ///< More than 1: it moves.
};
const std::vector<SceneInfo>& scene_list();
std::vector<std::string> scene_names();

/// Throws Error(usage) on an unknown name.
const SceneInfo& scene_info(const std::string& name);

/// Throws Error(usage) on an unknown name, a size outside 1...16384, or a frame (the first is 1)
/// that the scene has not.
Scene make_scene(const std::string& name, int width, int height, int frame = 1);

/// The setting of this name. Throws Error(usage) with the scene's settings where there is none.
const FocusSetting& find_setting(const Scene& scene, const std::string& name);

/// The scene's camera focused like this. Scene units are metres.
Lens lens_of(const Scene& scene, const FocusSetting& setting);

/// Focal length in pixels.
double pixel_focal_length(const Scene& scene);

/// The camera with all focus settings as a camera.json. `noise` has, for the settings whose truth
/// was rendered, how far its halves are apart (see Truth); it is stored with the setting.
std::string camera_json(const Scene& scene, const std::map<std::string, Comparison>& noise = {});

}  // namespace defray
