// Shinya 1994, plate 1: a thin dark rectangle in focus before a finely textured polygon, and, for
// the other kind of occlusion, a near ball out of focus.
#include <cmath>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"

namespace defray {
namespace {

/// Fine plaid with a coarse checker under it: contrast at two scales.
Vec3 plaid(const Vec3& p) {
  const auto wave = [](double at, double period) {
    return 0.5 + 0.5 * std::sin(6.2831853 * at / period);
  };
  const double fine = wave(p.x, 0.045) * wave(p.y, 0.045);
  const bool dark =
      (static_cast<int>(std::floor(p.x / 0.3)) + static_cast<int>(std::floor(p.y / 0.3))) & 1;
  const double base = dark ? 0.12 : 0.45;
  return {base + 0.5 * fine, base + 0.35 * fine, 0.75 * base + 0.15 * fine};
}

}  // namespace

Scene make_plate1(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", 3, 50 / 0.95}};
  // From the upper left, behind the camera.
  scene.light = {{-0.5, -0.6, -0.62}, {0.88, 0.88, 0.88}, {0.12, 0.12, 0.12}, {0.12, 0.12, 0.12}};
  const Texture dark = plain({0.01, 0.01, 0.012});
  scene.primitives.push_back(std::make_unique<Rectangle>(-3, -3, 3, 3, 6, plaid));
  scene.primitives.push_back(std::make_unique<Rectangle>(-0.9, -0.05, 0.9, 0.03, 3, dark));
  scene.primitives.push_back(std::make_unique<Rectangle>(-0.42, -0.6, -0.38, 0.6, 3, dark));
  scene.primitives.push_back(
      std::make_unique<Ball>(Vec3{0.17, 0.1, 1.1}, 0.11, plain({0.85, 0.32, 0.08})));
  return scene;
}

}  // namespace defray
