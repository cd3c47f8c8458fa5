// Near bars before a brick wall in focus, or the other way round: behind the bars' soft edges the
// lens sees wall that the pinhole does not.
#include <cmath>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double wall_depth = 6, fence_depth = 1.5;

/// Bright paint on a round bar around x = 0, rings along it so that its blur can be seen.
Texture painted(double x, double half_width) {
  return [=](const Vec3& p) {
    const double across = (p.x - x) / half_width;
    const double round = 0.25 + 0.75 * std::sqrt(std::fmax(0, 1 - across * across));
    const bool ring = std::fmod(p.y + 10, 0.12) < 0.03;
    return (ring ? Vec3{0.75, 0.1, 0.06} : Vec3{0.7, 0.72, 0.68}) * round;
  };
}

}  // namespace

Scene make_fence(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  const double aperture_mm = 50 / 0.95;
  scene.settings = {{"bg", wall_depth, aperture_mm}, {"fence", fence_depth, aperture_mm}};
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-6, -6, 6, 6, wall_depth, [](const Vec3& p) {
        const double light = 0.75 - 0.08 * p.x - 0.1 * p.y;
        return bricks(p.x, p.y, 0.36, 0.13) * light;
      }));
  constexpr double spacing = 0.13, half_width = 0.012;
  for (int i = -10; i <= 10; ++i) {
    const double x = i * spacing + 0.03;
    scene.primitives.push_back(std::make_unique<Rectangle>(x - half_width, -2, x + half_width, 2,
                                                           fence_depth, painted(x, half_width)));
  }
  return scene;
}

}  // namespace defray
