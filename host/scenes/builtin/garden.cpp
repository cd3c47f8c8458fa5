// Grass swaying before dusk, and lamps that pass behind a near post: thin things at all depths, and
// discs of which the lens sees another part in each frame. Lengths in pixels are of a picture 640
// wide.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/builtin/builtin.h"
#include "scenes/geometry/flat_shapes.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double post_depth = 1.2, grass_depth = 2.4, hedge_depth = 11;
constexpr double px_unit = 36 / 50.0 / 640;  ///< At depth 1, in units.

/// How far round a movement is that begins anew after the last frame, in radians.
double turn_of(int frame) { return 2 * std::numbers::pi * (frame - 1) / garden_frames; }

/// A blade that grows from below the picture and bends sidewise, the more the higher; its tip sways
/// by up to 5 px.
std::unique_ptr<Primitive> blade(const Scene& scene, int i, double z, int frame) {
  const double unit = z * px_unit;
  const double half_height = 320.0 * scene.height / scene.width;
  const double root_x = (hash01(i, 1) - 0.5) * 720, root_y = half_height + 20;
  const double height = half_height * (0.6 + 0.9 * hash01(i, 2));
  const double sway = (2 + 3 * hash01(i, 3)) * std::sin(turn_of(frame) + 6 * hash01(i, 4));
  const double bend = 90 * (hash01(i, 5) - 0.5) + sway;
  const double half_width = 0.7 + 2.3 * hash01(i, 6);
  constexpr int joints = 6;
  std::vector<std::array<double, 2>> left, right;
  for (int k = 0; k < joints; ++k) {
    const double t = k / double{joints};
    const double x = root_x + bend * t * t, y = root_y - height * t,
                 half = half_width * (1 - t * t);
    left.push_back({(x - half) * unit, y * unit});
    right.push_back({(x + half) * unit, y * unit});
  }
  left.push_back({(root_x + bend) * unit, (root_y - height) * unit});
  left.insert(left.end(), right.rbegin(), right.rend());
  const Vec3 fresh{0.16, 0.3, 0.07}, dry{0.5, 0.42, 0.18};
  const Vec3 colour = mix(fresh, dry, hash01(i, 7)) * (0.5 + 0.8 * hash01(i, 8));
  return std::make_unique<Polygon>(std::move(left), z, colour);
}

/// Lamps in rows, which go to the right by 2 to 4 px a frame.
std::unique_ptr<Primitive> lamp(const Scene& scene, int i, int frame) {
  const double z = 4.5 + 4.5 * hash01(i, 11), unit = z * px_unit;
  const double speed = 2 + 2 * hash01(i, 12);
  const double x = -370 + 52 * i + 20 * hash01(i, 13) + speed * (frame - 1);
  const double y = (hash01(i, 14) - 0.7) * 260.0 * scene.height / scene.width;
  const Vec3 hue = mix({1, 0.6, 0.25}, {0.6, 0.8, 1}, hash01(i, 15));
  const double radius = 1.5 + 1.5 * hash01(i, 16);
  return std::make_unique<Emitter>(Vec3{x * unit, y * unit, z}, radius * unit,
                                   hue * (15 * std::pow(10, hash01(i, 17))));
}

/// Rough bark, lighter on the left.
std::unique_ptr<Primitive> post(double x, double half_width) {
  return std::make_unique<Rectangle>(
      x - half_width, -2, x + half_width, 2, post_depth, [=](const Vec3& p) {
        const double across = (p.x - x) / half_width;
        const double bark =
            value_noise(500 * p.x, 60 * p.y, 3) * value_noise(120 * p.x, 20 * p.y, 4);
        return Vec3{0.34, 0.25, 0.18} * ((0.3 + 1.2 * bark) * (0.7 - 0.4 * across));
      });
}

}  // namespace

Scene make_garden(int width, int height, int frame) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  constexpr double aperture_mm = 50 / 0.95;
  scene.settings = {{"grass", grass_depth, aperture_mm}, {"post", post_depth, aperture_mm}};
  constexpr double reach = 2 * hedge_depth;
  scene.primitives.push_back(
      std::make_unique<Rectangle>(-reach, -reach, reach, reach, hedge_depth, [](const Vec3& p) {
        const double leaves =
            0.6 * value_noise(1.5 * p.x, 1.5 * p.y, 1) + 0.4 * value_noise(9 * p.x, 9 * p.y, 2);
        const double height = std::clamp(0.5 - 0.15 * p.y, 0.0, 1.0);
        const Vec3 dusk = mix({0.34, 0.2, 0.16}, {0.1, 0.14, 0.26}, height);
        return mix(dusk, {0.03, 0.06, 0.03}, leaves);
      }));
  constexpr int blades = 150, lamps = 13;
  for (int i = 0; i < blades; ++i) {
    // A fifth of them where the grass is in focus, the others evenly in 1/z.
    const double z = i % 5 == 0 ? grass_depth : 1 / (0.12 + 0.55 * (i + 0.5) / blades);
    scene.primitives.push_back(blade(scene, i, z, frame));
  }
  for (int i = 0; i < lamps; ++i) scene.primitives.push_back(lamp(scene, i, frame));
  scene.primitives.push_back(post(-0.105, 0.022));
  scene.primitives.push_back(post(0.16, 0.034));
  return scene;
}

}  // namespace defray
