// A plane from near left to far right through the plane of focus: every blur in one picture.
#include <cmath>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

/// A ruler's scale along the plane, over coloured squares.
Vec3 chart(const Vec3& p) {
  const double tick = std::fmod(p.x, 0.1), decimetre = std::fmod(p.x, 0.5);
  const bool is_mark =
      decimetre < 0.02 ? std::fmod(p.y, 0.8) < 0.4 : tick < 0.012 && std::fmod(p.y, 0.8) < 0.2;
  if (is_mark) return {0.02, 0.02, 0.03};
  const auto at = [](double v) { return static_cast<std::int64_t>(std::floor(v / 0.4)); };
  const Vec3 hue = mix({0.8, 0.55, 0.3}, {0.3, 0.55, 0.75}, hash01(at(p.x), at(p.y)));
  return checker(p.x, p.y, 0.1, hue, hue * 0.55);
}

}  // namespace

Scene make_slanted(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", 3, 50 / 0.95}};
  // Through (0, 0, 3), from 1.8 at the picture's left edge to 10 at its right one.
  const Vec3 along{std::sin(0.48), 0, std::cos(0.48)};
  const Vec3 corner = Vec3{0, -40, 3} - along * 1.9;
  scene.primitives.push_back(
      std::make_unique<Quad>(corner, along * 12, Vec3{0, 80, 0}, chart, Quad::Kind::unlit));
  return scene;
}

}  // namespace defray
