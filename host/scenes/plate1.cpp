// Shinya 1994, plate 1: a thin dark rectangle in focus before a finely textured polygon, and, for
// the other kind of occlusion, a near ball out of focus.
#include <cmath>

#include "scenes/builtin.h"

namespace defray {
namespace {

/// A rectangle parallel to the picture plane.
class Rectangle : public Primitive {
 public:
  using Texture = Vec3 (*)(double x, double y);
  Rectangle(double x0, double y0, double x1, double y1, double depth, Texture texture)
      : x0_(x0), y0_(y0), x1_(x1), y1_(y1), depth_(depth), texture_(texture) {}

  bool intersect(const Vec3& o, const Vec3& d, Hit& hit) const override {
    if (depth_ >= hit.depth) return false;
    const double x = o.x + depth_ * d.x, y = o.y + depth_ * d.y;
    if (x < x0_ || x >= x1_ || y < y0_ || y >= y1_) return false;
    hit = {depth_, texture_(x, y)};
    return true;
  }

 private:
  double x0_, y0_, x1_, y1_, depth_;
  Texture texture_;
};

class Ball : public Primitive {
 public:
  Ball(Vec3 centre, double radius) : centre_(centre), radius_(radius) {}

  bool intersect(const Vec3& o, const Vec3& d, Hit& hit) const override {
    const Vec3 m{o.x - centre_.x, o.y - centre_.y, o.z - centre_.z};
    const double a = d.x * d.x + d.y * d.y + d.z * d.z;
    const double b = m.x * d.x + m.y * d.y + m.z * d.z;
    const double c = m.x * m.x + m.y * m.y + m.z * m.z - radius_ * radius_;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return false;
    const double t = (-b - std::sqrt(discriminant)) / a;
    if (t <= 0 || t >= hit.depth) return false;
    // Lambert's cosine under a light from the upper left, behind the camera.
    const Vec3 n{(m.x + t * d.x) / radius_, (m.y + t * d.y) / radius_, (m.z + t * d.z) / radius_};
    const double lambert = std::fmax(0, (-0.5 * n.x - 0.6 * n.y - 0.62 * n.z));
    const double light = 0.12 + 0.88 * lambert;
    hit = {t, {0.85 * light, 0.32 * light, 0.08 * light}};
    return true;
  }

 private:
  Vec3 centre_;
  double radius_;
};

/// Fine plaid with a coarse checker under it: contrast at two scales.
Vec3 plaid(double x, double y) {
  const auto wave = [](double at, double period) {
    return 0.5 + 0.5 * std::sin(6.2831853 * at / period);
  };
  const double fine = wave(x, 0.045) * wave(y, 0.045);
  const bool dark =
      (static_cast<int>(std::floor(x / 0.3)) + static_cast<int>(std::floor(y / 0.3))) & 1;
  const double base = dark ? 0.12 : 0.45;
  return {base + 0.5 * fine, base + 0.35 * fine, 0.75 * base + 0.15 * fine};
}

Vec3 dark(double, double) { return {0.01, 0.01, 0.012}; }

}  // namespace

Scene make_plate1(int width, int height) {
  Scene scene;
  scene.name = "plate1";
  scene.width = width;
  scene.height = height;
  scene.lens.focal_length_mm = 50;
  scene.lens.sensor_width_mm = 36;
  scene.lens.aperture_diameter_mm = 50 / 0.95;
  scene.lens.focus_distance_units = 3;
  scene.primitives.push_back(std::make_unique<Rectangle>(-3, -3, 3, 3, 6, plaid));
  scene.primitives.push_back(std::make_unique<Rectangle>(-0.9, -0.05, 0.9, 0.03, 3, dark));
  scene.primitives.push_back(std::make_unique<Rectangle>(-0.42, -0.6, -0.38, 0.6, 3, dark));
  scene.primitives.push_back(std::make_unique<Ball>(Vec3{0.17, 0.1, 1.1}, 0.11));
  return scene;
}

}  // namespace defray
