#include "scenes/geometry/texture.h"

#include <cmath>
#include <initializer_list>

namespace defray {

double hash01(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  std::uint64_t h = 0;
  for (const std::int64_t value : {a, b, c, d}) {  // splitmix64's finalizer after each
    h = (h ^ static_cast<std::uint64_t>(value)) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

double value_noise(double x, double y, std::int64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double sx = smooth(x - fx), sy = smooth(y - fy);
  const double top = std::lerp(hash01(ix, iy, seed), hash01(ix + 1, iy, seed), sx);
  const double bottom = std::lerp(hash01(ix, iy + 1, seed), hash01(ix + 1, iy + 1, seed), sx);
  return std::lerp(top, bottom, sy);
}

Vec3 checker(double x, double y, double size, const Vec3& even, const Vec3& odd) {
  const auto ix = static_cast<std::int64_t>(std::floor(x / size));
  const auto iy = static_cast<std::int64_t>(std::floor(y / size));
  const double grain =
      0.85 + 0.15 * hash01(ix, iy, 1) + 0.2 * (value_noise(12 * x / size, 12 * y / size, 2) - 0.5);
  return ((ix + iy) & 1 ? odd : even) * grain;
}

Vec3 bricks(double x, double y, double brick_width, double brick_height) {
  const auto course = static_cast<std::int64_t>(std::floor(y / brick_height));
  const double along = x / brick_width + (course & 1 ? 0.5 : 0);
  const auto brick = static_cast<std::int64_t>(std::floor(along));
  const double in_x = (along - static_cast<double>(brick)) * brick_width;
  const double in_y = y - static_cast<double>(course) * brick_height;
  const double joint = 0.12 * brick_height;
  const double grain =
      0.8 + 0.4 * value_noise(18 * x / brick_width, 9 * y / brick_height, brick ^ course);
  if (in_x < joint || in_y < joint) return Vec3{0.55, 0.53, 0.5} * grain;
  const double tone = hash01(brick, course, 3);
  return mix({0.42, 0.13, 0.07}, {0.62, 0.28, 0.16}, tone) * grain;
}

}  // namespace defray
