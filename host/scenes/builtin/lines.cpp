// Thin lines before, in and behind the plane of focus: where one depth a pixel is hardest.
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/primitives.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr double focus = 3, wall = 8;

/// A straight line through a point of the picture (shares of its width from the middle), as many
/// pixels wide as stated, at this depth.
std::unique_ptr<Primitive> line(const Scene& scene, double x, double y, double angle, double depth,
                                double width_px, const Vec3& colour) {
  const double per_share = depth * scene.sensor_width_mm / scene.focal_length_mm;
  const Vec3 along{std::cos(angle), std::sin(angle), 0}, across{-along.y, along.x, 0};
  const double half_length = 2 * per_share;
  const double line_width = width_px * depth / pixel_focal_length(scene);
  const Vec3 middle{x * per_share, y * per_share, depth};
  return std::make_unique<Quad>(middle - along * half_length - across * (line_width / 2),
                                along * (2 * half_length), across * line_width, plain(colour),
                                Quad::Kind::unlit);
}

}  // namespace

Scene make_lines(int width, int height) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.settings = {{"default", focus, 50 / 1.2}};
  scene.primitives.push_back(std::make_unique<Rectangle>(-8, -8, 8, 8, wall, [](const Vec3& p) {
    const Vec3 sky = mix({0.75, 0.5, 0.32}, {0.2, 0.32, 0.55}, std::fmin(1, 0.5 - 0.25 * p.y));
    return checker(p.x, p.y, 0.5, sky, sky * 0.6);
  }));
  constexpr int count = 18;
  for (int i = 0; i < count; ++i) {
    const double depth = i % 3 == 0 ? focus : i % 3 == 1 ? 1.4 + 0.1 * i : 4 + 0.15 * i;
    const double width_px = 1 + i / 3 % 3;
    const bool is_dark = i & 1;
    const Vec3 colour = is_dark ? Vec3{0.01, 0.01, 0.015} : Vec3{1.6, 1.5, 1.3};
    const double angle = 0.3 * (hash01(i, 1) - 0.5) + (i % 4 == 3 ? 1.5 : 0.12);
    scene.primitives.push_back(line(scene, hash01(i, 2) - 0.5, 0.75 * ((i + 0.5) / count - 0.5),
                                    angle, depth, width_px, colour));
  }
  return scene;
}

}  // namespace defray
