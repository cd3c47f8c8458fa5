// One bright pixel each at many depths before a flat dark wall. The pixel is exactly filled, so
// that its blur is the circle of confusion, folded with one pixel's square.
#include <set>
#include <utility>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"

namespace defray {
namespace {

constexpr int columns = 9, rows = 7;
constexpr double focus = 4, wall = 1000;

/// The depth whose circle of confusion is `share` of the background's, negative in front.
double depth_of(double share) { return focus / (1 - share); }

/// A square that covers this pixel of the picture and no other.
std::unique_ptr<Primitive> impulse(const Scene& scene, int x, int y, double depth) {
  const double pixel = depth / pixel_focal_length(scene);
  const double left = (x - scene.width / 2.0) * pixel, top = (y - scene.height / 2.0) * pixel;
  return std::make_unique<Rectangle>(left, top, left + pixel, top + pixel, depth,
                                     plain({200, 200, 200}));
}

}  // namespace

Scene make_impulses(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", focus, 200}};
  const double reach = 2 * wall;
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-reach, -reach, reach, reach, wall, plain({0.02, 0.02, 0.02})));
  std::set<std::pair<int, int>> lit;  // in a tiny picture, several would share a pixel
  for (int i = 0; i < columns * rows; ++i) {
    const int x = (2 * (i % columns) + 1) * width / (2 * columns);
    const int y = (2 * (i / columns) + 1) * height / (2 * rows);
    if (!lit.insert({x, y}).second) continue;
    const double share = -1 + 1.9 * i / (columns * rows - 1);
    scene.primitives.push_back(impulse(scene, x, y, depth_of(share)));
  }
  return scene;
}

}  // namespace defray
