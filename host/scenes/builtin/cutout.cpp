// Discs and polygons at many depths, some before others, and nothing behind: a layer to be put over
// another picture, where alpha must blur like colour.
#include <cmath>
#include <numbers>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/flat_shapes.h"

namespace defray {
namespace {

/// A place in the picture: shares of its width from the middle.
Vec3 place(double x, double y, double depth) {
  const double per_share = depth * 36 / 50.0;  // sensor width over focal length
  return {x * per_share, y * per_share, depth};
}

/// `radius` and the disc's place in shares of the picture's width.
void add_disc(Scene& scene, double x, double y, double radius, double depth, const Vec3& colour) {
  scene.primitives.push_back(
      std::make_unique<Disc>(place(x, y, depth), place(radius, 0, depth).x, colour));
}

/// A regular polygon; with `inner` < 1 a star whose inner corners are that much nearer to its
/// middle.
void add_star(Scene& scene, double x, double y, double radius, int tips, double inner, double depth,
              const Vec3& colour) {
  std::vector<std::array<double, 2>> corners;
  for (int i = 0; i < 2 * tips; ++i) {
    const double angle = std::numbers::pi * (i + 0.3) / tips;
    const double r = i % 2 ? radius * inner * std::cos(std::numbers::pi / tips) : radius;
    const Vec3 corner = place(x + r * std::cos(angle), y + r * std::sin(angle), depth);
    corners.push_back({corner.x, corner.y});
  }
  scene.primitives.push_back(std::make_unique<Polygon>(corners, depth, colour));
}

}  // namespace

Scene make_cutout(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  constexpr double aperture_mm = 50 / 0.95;
  scene.settings = {{"near", 1.5, aperture_mm}, {"far", 5, aperture_mm}};
  add_disc(scene, 0, 0, 0.11, 5, {0.75, 0.7, 0.6});
  add_disc(scene, 0.06, 0.07, 0.05, 1.5, {0.8, 0.2, 0.1});
  add_star(scene, -0.3, -0.13, 0.12, 5, 0.5, 3, {0.9, 0.75, 0.1});
  add_star(scene, -0.2, 0.16, 0.1, 3, 1, 2, {0.1, 0.45, 0.7});
  add_disc(scene, -0.36, 0.1, 0.06, 1.5, {0.2, 0.6, 0.3});
  add_star(scene, 0.26, -0.12, 0.13, 6, 1, 8, {0.35, 0.3, 0.65});
  add_disc(scene, 0.31, -0.2, 0.04, 2.5, {0.95, 0.95, 0.95});
  add_star(scene, 0.32, 0.17, 0.12, 4, 0.3, 1.5, {0.7, 0.35, 0.55});
  return scene;
}

}  // namespace defray
