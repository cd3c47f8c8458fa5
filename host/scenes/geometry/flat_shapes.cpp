#include "scenes/geometry/flat_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace defray {
namespace {

Bounds square_around(const Vec3& centre, double half_size) {
  const Vec3 half{half_size, half_size, 0};
  return {centre - half, centre + half};
}

}  // namespace

std::array<double, 2> disc_point(double s, double t) {
  const double r = std::sqrt(s), phi = 2 * std::numbers::pi * t;
  return {r * std::cos(phi), r * std::sin(phi)};
}

bool FlatShape::intersect(const Ray& ray, Hit& hit) const {
  const double t = (depth_ - ray.origin.z) / ray.direction.z;
  if (!(t > ray.from && t < hit.t)) return false;
  if (!contains(ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y))
    return false;
  hit = {t, colour_, {}};
  return true;
}

Disc::Disc(const Vec3& centre, double radius, const Vec3& colour)
    : FlatShape(centre.z, colour), centre_(centre), radius_(radius) {}

bool Disc::contains(double x, double y) const {
  return std::hypot(x - centre_.x, y - centre_.y) < radius_;
}

Bounds Disc::bounds() const { return square_around(centre_, radius_); }

void Disc::add_crossings(double y, std::vector<double>& xs) const {
  const double off = y - centre_.y, squared = radius_ * radius_ - off * off;
  if (!(squared > 0)) return;
  xs.push_back(centre_.x - std::sqrt(squared));
  xs.push_back(centre_.x + std::sqrt(squared));
}

/// Of its sides, in their order.
template <typename Visit>
void Polygon::for_each_crossing(double y, const Visit& visit) const {
  for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
    const auto [ax, ay] = corners_[i];
    const auto [bx, by] = corners_[j];
    if ((ay > y) != (by > y)) visit(ax + (bx - ax) * (y - ay) / (by - ay));
  }
}

Polygon::Polygon(std::vector<std::array<double, 2>> corners, double depth, const Vec3& colour)
    : FlatShape(depth, colour), corners_(std::move(corners)) {}

bool Polygon::contains(double x, double y) const {
  bool is_inside = false;
  for_each_crossing(y, [&](double at) { is_inside ^= x < at; });
  return is_inside;
}

void Polygon::add_crossings(double y, std::vector<double>& xs) const {
  const auto first = static_cast<std::ptrdiff_t>(xs.size());
  for_each_crossing(y, [&](double at) { xs.push_back(at); });
  std::sort(xs.begin() + first, xs.end());
}

Bounds Polygon::bounds() const {
  Bounds b{{corners_[0][0], corners_[0][1], depth()}, {corners_[0][0], corners_[0][1], depth()}};
  for (const auto& [x, y] : corners_) {
    b.low = {std::min(b.low.x, x), std::min(b.low.y, y), depth()};
    b.high = {std::max(b.high.x, x), std::max(b.high.y, y), depth()};
  }
  return b;
}

Emitter::Emitter(const Vec3& centre, double radius, const Vec3& radiance)
    : centre_(centre), radius_(radius), radiance_(radiance), disc_(centre, radius, radiance) {}

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
