// Balls at many depths over a checkered floor, with small lamps far brighter than white.
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double floor_y = 0.7;

/// Two colours in bands along the ball's own axis.
Texture striped(const Vec3& light, const Vec3& dark) {
  return [=](const Vec3& n) {
    const double along = 0.6 * n.x - 0.7 * n.y + 0.39 * n.z;
    return static_cast<int>((along + 1) * 5) & 1 ? dark : light;
  };
}

void add_ball(Scene& scene, double x, double z, double radius, Texture texture) {
  scene.primitives.push_back(
      std::make_unique<Ball>(Vec3{x, floor_y - radius, z}, radius, std::move(texture)));
}

void add_lamps(Scene& scene) {
  constexpr int count = 14;
  for (int i = 0; i < count; ++i) {
    const double z = 1.6 + 10 * i / double{count};
    const Vec3 centre{z * 0.6 * (hash01(i, 1) - 0.5), floor_y - 0.25 - 0.13 * z * hash01(i, 2), z};
    const Vec3 hue = mix({1, 0.55, 0.2}, {0.45, 0.7, 1}, hash01(i, 3));
    const double radiance = 20 + 180 * hash01(i, 4);
    scene.primitives.push_back(std::make_unique<Lamp>(centre, 0.0035 * z, hue * radiance));
  }
}

}  // namespace

Scene make_spheres(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"f2", 2, 50 / 0.95}, {"f5", 5, 50 / 0.95}};
  scene.light = {
      normalized({-0.5, -0.8, -0.45}), {0.85, 0.8, 0.7}, {0.22, 0.26, 0.34}, {0.1, 0.09, 0.08}};
  scene.background = [](const Vec3& d) {
    return mix({0.55, 0.62, 0.7}, {0.12, 0.25, 0.5}, std::fmin(1, std::fmax(0, -3 * d.y)));
  };
  scene.primitives.push_back(std::make_unique<Quad>(
      Vec3{-30, floor_y, 0.5}, Vec3{60, 0, 0}, Vec3{0, 0, 60}, [](const Vec3& p) {
        return checker(p.x + 0.17, p.y, 0.4, {0.62, 0.58, 0.52}, {0.16, 0.17, 0.2});
      }));
  add_ball(scene, -0.42, 1.6, 0.2, striped({0.8, 0.25, 0.1}, {0.75, 0.7, 0.6}));
  add_ball(scene, 0.2, 2, 0.25, plain({0.15, 0.4, 0.65}));
  add_ball(scene, -0.55, 3.2, 0.42, striped({0.2, 0.5, 0.25}, {0.75, 0.75, 0.5}));
  add_ball(scene, 1.05, 3.6, 0.45, striped({0.7, 0.65, 0.6}, {0.25, 0.22, 0.3}));
  add_ball(scene, 0.15, 5, 0.55, plain({0.7, 0.55, 0.15}));
  add_ball(scene, -1.9, 7, 0.9, striped({0.55, 0.2, 0.4}, {0.8, 0.75, 0.75}));
  add_ball(scene, 2, 12, 1.5, plain({0.35, 0.6, 0.6}));
  add_lamps(scene);
  return scene;
}

}  // namespace defray
