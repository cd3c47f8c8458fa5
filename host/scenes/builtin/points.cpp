// Bright points by night: each becomes a disc as large as its circle of confusion.
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

/// Radiance of lamps: street, window, signal.
Vec3 hue_of(double which) {
  if (which < 0.45) return {1, 0.62, 0.25};
  if (which < 0.75) return {0.95, 0.9, 0.8};
  if (which < 0.88) return {0.3, 1, 0.55};
  return {1, 0.18, 0.12};
}

/// A row of houses at the horizon, some windows dimly lit.
void add_skyline(Scene& scene) {
  const auto windows = [](const Vec3& p) {
    const auto column = static_cast<std::int64_t>(std::floor(p.x)),
               storey = static_cast<std::int64_t>(std::floor(p.y));
    const bool is_pane = p.x - std::floor(p.x) > 0.45 && p.y - std::floor(p.y) > 0.4;
    const bool is_lit = is_pane && hash01(column, storey) > 0.7;
    return is_lit ? Vec3{0.5, 0.36, 0.16} : Vec3{0.008, 0.009, 0.014};
  };
  for (int i = -5; i <= 5; ++i) {
    const double half_height = 2 + 4.5 * hash01(i, 10);
    scene.primitives.push_back(std::make_unique<Box>(Vec3{5.2 * i, 0.9 - half_height, 50},
                                                     Vec3{2.4, half_height, 2}, 0, windows));
  }
}

}  // namespace

Scene make_points(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", 5, 50 / 0.95}};
  scene.background = [](const Vec3& d) {
    return mix({0.03, 0.035, 0.06}, {0.004, 0.006, 0.014}, std::fmin(1, std::fmax(0, -5 * d.y)));
  };
  scene.primitives.push_back(std::make_unique<Quad>(
      Vec3{-60, 0.9, 1}, Vec3{120, 0, 0}, Vec3{0, 0, 100},
      [](const Vec3& p) {
        const double wet = value_noise(3 * p.x, 3 * p.y, 1) * value_noise(0.7 * p.x, p.y, 2);
        return Vec3{0.02, 0.022, 0.03} * (0.3 + 2 * wet);
      },
      Quad::Kind::unlit));
  add_skyline(scene);
  constexpr int count = 70;
  for (int i = 0; i < count; ++i) {
    // Evenly in 1/z from 1.2 to 40 units, so that circles of every size occur.
    const double z = 1 / (1 / 1.2 + (1 / 40.0 - 1 / 1.2) * (i + 0.5) / count);
    const Vec3 centre{z * 0.66 * (hash01(i, 5) - 0.5), z * (0.2 - 0.42 * hash01(i, 6)), z};
    const double radiance = 5 * std::pow(40, hash01(i, 7));
    // Two to three pixels in radius of a picture 640 wide, at any distance: smaller ones would need
    // very many samples for a clean truth.
    const double radius = z * (0.002 + 0.001 * hash01(i, 8));
    scene.primitives.push_back(
        std::make_unique<Lamp>(centre, radius, hue_of(hash01(i, 9)) * radiance));
  }
  return scene;
}

}  // namespace defray
