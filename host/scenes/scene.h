#pragma once
// Built-in analytic scenes: a pinhole picture with depth, and the truth through a real lens.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lens.h"
#include "rdb.h"

namespace defray {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

/// A point hit by a ray: its planar depth (scene units) and its linear colour.
struct Hit {
  double depth = 0;
  Vec3 colour;
};

/// Something that a ray can hit. The camera is at the origin and looks along +z; x is right, y
/// down.
class Primitive {
 public:
  virtual ~Primitive() = default;
  /// The hit of origin + t direction (direction.z = 1) nearer than `hit.depth`, if there is one.
  virtual bool intersect(const Vec3& origin, const Vec3& direction, Hit& hit) const = 0;
};

struct Scene {
  std::string name;
  int width = 0, height = 0;
  Lens lens;
  std::vector<std::unique_ptr<Primitive>> primitives;
};

/// Names that make_scene knows.
std::vector<std::string> scene_names();

/// Throws Error(usage) on an unknown name or a size outside 1...16384.
Scene make_scene(const std::string& name, int width, int height);

struct ScenePicture {
  std::vector<Plane> colour;  ///< R G B.
  Plane depth;                ///< Planar; 1e10 where nothing is hit. Empty for truth.
};

/// What a renderer's pinhole camera gives: one ray through each pixel's centre.
ScenePicture render_pinhole(const Scene& scene);

/// What the lens gives: the scene traced through `samples` stratified points of the aperture and
/// of the pixel's square, for each pixel. Throws Error(usage) unless 1 <= samples <= 65536.
ScenePicture render_truth(const Scene& scene, int samples, std::uint32_t seed,
                          const std::function<void(double)>& progress = {});

/// The scene's lens as a camera.json.
std::string camera_json(const Scene& scene);

}  // namespace defray
