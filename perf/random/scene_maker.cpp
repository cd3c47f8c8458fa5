#include "random/scene_maker.h"

#include <numbers>

#include "scenes/geometry/texture.h"

namespace defray::perf {

SceneMaker::SceneMaker(const std::string& name, int width, int height, std::uint32_t seed)
    : random_(0, 0, seed), seed_(seed) {
  scene_.name = name;
  scene_.width = width;
  scene_.height = height;
  scene_.focal_length_mm = focal_length_mm;
  scene_.sensor_width_mm = sensor_width_mm;
}

Texture SceneMaker::texture(double depth) {
  const Vec3 a = colour(), b = colour();
  const double size = width_at(depth) * log_between(0.01, 0.15);
  const std::int64_t seed = seed_ * 16 + static_cast<std::uint32_t>(count(16));
  switch (count(5)) {
    case 0:
      return plain(a);
    case 1:
      return [=](const Vec3& p) { return checker(p.x + 50, p.y + 50, size, a, b); };
    case 2:
      return [=](const Vec3& p) { return bricks(p.x + 50, p.y + 50, 2 * size, size) * a * 2; };
    case 3:
      return [=](const Vec3& p) {
        return mix(a, b, value_noise((p.x + 50) / size, (p.y + 50) / size, seed));
      };
    default:
      return [=](const Vec3& p) {
        const double wave = std::sin((p.x + 0.5 * p.y) / size * std::numbers::pi);
        return mix(a, b, 0.5 + 0.5 * wave);
      };
  }
}

void SceneMaker::add_bar(const Vec3& middle, double half_width, double half_length, double angle,
                         const Texture& texture) {
  const Vec3 along{std::sin(angle), std::cos(angle), 0}, across{along.y, -along.x, 0};
  add(std::make_unique<Quad>(middle - along * half_length - across * half_width,
                             across * (2 * half_width), along * (2 * half_length), texture,
                             Quad::Kind::unlit));
}

void SceneMaker::set_focus(const std::string& name) {
  const double focus = depths_[static_cast<std::size_t>(count(static_cast<int>(depths_.size())))];
  const double share = log_between(0.005, 0.05), f = focal_length_mm / 1000;
  double most = 0;  // CoC radius over the picture's width, of an aperture of 1 m
  for (const double z : depths_) {
    const double off = std::fabs(z - focus) / z * f / (focus - f) / 2;
    most = std::fmax(most, off * 1000 / sensor_width_mm);
  }
  const double aperture_m = most > 0 ? share / most : 0.02;
  scene_.settings = {{name, focus, 1000 * std::fmin(aperture_m, 0.2)}};
}

}  // namespace defray::perf
