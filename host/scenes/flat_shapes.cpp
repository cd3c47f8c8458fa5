#include "scenes/flat_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace defray {
namespace {

/// Where the ray meets the plane of this depth, unless something lies before it.
std::optional<Vec3> point_at(const Ray& ray, const Hit& hit, double depth) {
  const double t = (depth - ray.origin.z) / ray.direction.z;
  if (!(t > ray.from && t < hit.t)) return std::nullopt;
  return Vec3{ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y, t};
}

Bounds square_around(const Vec3& centre, double half_size) {
  const Vec3 half{half_size, half_size, 0};
  return {centre - half, centre + half};
}

}  // namespace

std::array<double, 2> disc_point(double s, double t) {
  const double r = std::sqrt(s), phi = 2 * std::numbers::pi * t;
  return {r * std::cos(phi), r * std::sin(phi)};
}

Disc::Disc(const Vec3& centre, double radius, Texture texture)
    : centre_(centre), radius_(radius), texture_(std::move(texture)) {}

bool Disc::intersect(const Ray& ray, Hit& hit) const {
  const auto p = point_at(ray, hit, centre_.z);
  if (!p || std::hypot(p->x - centre_.x, p->y - centre_.y) >= radius_) return false;
  hit = {p->z, texture_({p->x, p->y, 0}), {}};
  return true;
}

Bounds Disc::bounds() const { return square_around(centre_, radius_); }

Polygon::Polygon(std::vector<std::array<double, 2>> corners, double depth, Texture texture)
    : corners_(std::move(corners)), depth_(depth), texture_(std::move(texture)) {}

bool Polygon::intersect(const Ray& ray, Hit& hit) const {
  const auto p = point_at(ray, hit, depth_);
  if (!p) return false;
  bool is_inside = false;
  for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
    const auto [ax, ay] = corners_[i];
    const auto [bx, by] = corners_[j];
    const bool crosses = (ay > p->y) != (by > p->y);
    if (crosses && p->x < ax + (bx - ax) * (p->y - ay) / (by - ay)) is_inside = !is_inside;
  }
  if (!is_inside) return false;
  hit = {p->z, texture_({p->x, p->y, 0}), {}};
  return true;
}

Bounds Polygon::bounds() const {
  Bounds b{{corners_[0][0], corners_[0][1], depth_}, {corners_[0][0], corners_[0][1], depth_}};
  for (const auto& [x, y] : corners_) {
    b.low = {std::min(b.low.x, x), std::min(b.low.y, y), depth_};
    b.high = {std::max(b.high.x, x), std::max(b.high.y, y), depth_};
  }
  return b;
}

Emitter::Emitter(const Vec3& centre, double radius, const Vec3& radiance)
    : centre_(centre),
      radius_(radius),
      radiance_(radiance),
      disc_(centre, radius, plain(radiance)) {}

bool Emitter::intersect(const Ray& ray, Hit& hit) const {
  if (!disc_.intersect(ray, hit)) return false;
  hit.emitter = this;
  return true;
}

double disc_overlap(double distance, double radius) {
  const double d = distance, r = radius;
  if (d >= 1 + r) return 0;
  if (d <= std::fabs(1 - r)) return r < 1 ? r * r : 1;
  // Two segments, each a sector less its triangle.
  const double x = (1 + d * d - r * r) / (2 * d);  // the common chord, from the unit disc's centre
  const auto segment = [](double size, double at) {
    const double cosine = std::clamp(at / size, -1.0, 1.0);
    return size * size * (std::acos(cosine) - cosine * std::sqrt(1 - cosine * cosine));
  };
  return (segment(1, x) + segment(r, d - x)) / std::numbers::pi;
}

}  // namespace defray
