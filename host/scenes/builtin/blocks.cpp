// Glatzel & Wilhelm's figure 8: two views of the block world from about 50 m, focused 75 m away, as
// the eye sees them and as if they were 6 cm away.
//
// The paper blurs by the eye's circle of confusion, 28000 px/m x A x 0.017 m / z0 x |1 - z0/z| in
// diameter, in a picture 1920 px wide. Our lens makes A_lens F / z0 x |1 - z0/z| with F the focal
// length in pixels; so A_lens = A x 0.017 x 28000 x (width / 1920) / F, which is the same for any
// width: the picture looks the same at any size.
#include <algorithm>

#include "scenes/builtin/block_grid.h"
#include "scenes/builtin/builtin.h"

namespace defray {
namespace {

constexpr double focus_m = 75;

double lens_aperture_mm(const Scene& scene, double eye_aperture_m) {
  const double px_per_metre = 28000 * scene.width / 1920.0, eye_depth_m = 0.017;
  return 1000 * eye_aperture_m * eye_depth_m * px_per_metre / pixel_focal_length(scene);
}

const BlockWorld& world() {
  static const BlockWorld only = make_block_world(9, 4);
  return only;
}

Scene make_blocks(int width, int height, const Viewpoint& view) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.focal_length_mm = 35;
  scene.settings = {{"normal", focus_m, lens_aperture_mm(scene, 0.0046)},
                    {"miniature", focus_m, lens_aperture_mm(scene, 5.75)}};
  scene.light = {view.to_camera(normalized({-0.55, 0.7, -0.25})),
                 {0.95, 0.88, 0.74},
                 {0.34, 0.4, 0.5},
                 {0.15, 0.14, 0.12},
                 view.to_camera({0, 1, 0})};
  const Vec3 up = scene.light.up;
  scene.background = [up](const Vec3& d) {
    const double rise = std::clamp(3 * dot(normalized(d), up), 0.0, 1.0);
    return mix({0.68, 0.77, 0.86}, {0.2, 0.42, 0.75}, rise);
  };
  scene.primitives.push_back(std::make_unique<BlockGrid>(world(), view));
  return scene;
}

}  // namespace

Scene make_blocks_lake(int width, int height) {
  return make_blocks(width, height, Viewpoint::looking({70, 51, 60}, 0.55, 0.63));
}

Scene make_blocks_forest(int width, int height) {
  return make_blocks(width, height, Viewpoint::looking({104, 54, 84}, 0.85, 0.63));
}

}  // namespace defray
