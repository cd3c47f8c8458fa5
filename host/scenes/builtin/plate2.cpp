// Shinya 1994, plate 2 and table 1: objects 3, 5 and 17 m away on a textured floor, f/R = 1. Of his
// scene only the distances are known; the objects are ours.
//
// A 50 mm lens on a 36 mm sensor with an aperture 50 mm in radius. At 640 x 480 the focal length
// is 889 px and the CoC radius K (z - z0) / z with K = 0.05 m x 889 px / z0: focused at 3 m
// 5.9 and 12.2 px (at 5 and 17 m), at 5 m 5.9 and 6.3 px, at 17 m 12.2 and 6.3 px, and at 1 m 30 to
// 42 px.
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double floor_y = 0.75;
constexpr int objects_each = 20;

/// Half a ball set with `count` small balls, evenly spread (a Fibonacci lattice).
void add_dome(Scene& scene, const Vec3& foot, double radius, int count, const Vec3& warm,
              const Vec3& cold) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double small = 1.25 * radius / std::sqrt(count);
  for (int i = 0; i < count; ++i) {
    const double up = (i + 0.5) / count, out = std::sqrt(1 - up * up);
    const Vec3 way{out * std::cos(golden_angle * i), -up, out * std::sin(golden_angle * i)};
    scene.primitives.push_back(
        std::make_unique<Ball>(foot + way * radius, small, plain(mix(warm, cold, hash01(i, 1)))));
  }
}

/// Houses of hashed heights on a square, `count` in all: as many columns as rows, nearly.
void add_town(Scene& scene, const Vec3& centre, double side, int count) {
  const int columns = static_cast<int>(std::sqrt(count));
  const int rows = (count + columns - 1) / columns;
  for (int i = 0; i < count; ++i) {
    const double x = (i % columns + 0.5) / columns - 0.5, z = (i / columns + 0.5) / rows - 0.5;
    const double middle = std::exp(-6 * (x * x + z * z));
    const double half_height = side * (0.06 + 0.38 * middle * (0.5 + 0.5 * hash01(i, 2)));
    const Vec3 hue = mix({0.75, 0.6, 0.4}, {0.6, 0.25, 0.18}, hash01(i, 3));
    scene.primitives.push_back(std::make_unique<Box>(
        centre + Vec3{x * side, -half_height, z * side},
        Vec3{0.42 * side / columns, half_height, 0.42 * side / rows}, 0.0, plain(hue)));
  }
}

void add_room(Scene& scene) {
  scene.primitives.push_back(std::make_unique<Quad>(
      Vec3{-20, floor_y, 0.5}, Vec3{40, 0, 0}, Vec3{0, 0, 22.5}, [](const Vec3& p) {
        return checker(p.x, p.y, 0.5, {0.6, 0.56, 0.5}, {0.2, 0.24, 0.28});
      }));
  scene.primitives.push_back(
      std::make_unique<Quad>(Vec3{-20, -20, 23}, Vec3{40, 0, 0}, Vec3{0, 21, 0},
                             [](const Vec3& p) { return bricks(p.x, p.y, 1.2, 0.5); }));
}

}  // namespace

Scene make_plate2(int width, int height, int complexity) {
  if (complexity < 1 || complexity > 1000) {
    fail(ErrorKind::usage, "complexity is {}: allowed are 1 to 1000", complexity);
  }
  Scene scene;
  scene.name = "plate2";
  scene.width = width;
  scene.height = height;
  for (const int z0 : {1, 3, 5, 17}) {
    scene.settings.push_back({fmt::format("f{}", z0), static_cast<double>(z0), 100});
  }
  scene.light = {
      normalized({0.5, -0.75, -0.5}), {0.8, 0.76, 0.68}, {0.26, 0.29, 0.34}, {0.13, 0.12, 0.1}};
  add_room(scene);
  const int count = objects_each * complexity;
  add_dome(scene, {-0.5, floor_y, 3}, 0.38, count, {0.75, 0.2, 0.12}, {0.8, 0.5, 0.15});
  add_town(scene, {0.75, floor_y, 5}, 1.3, count);
  add_dome(scene, {-1.2, floor_y, 17}, 3.2, count, {0.15, 0.35, 0.6}, {0.3, 0.6, 0.45});
  return scene;
}

}  // namespace defray
