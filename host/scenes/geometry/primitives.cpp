#include "scenes/geometry/primitives.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace defray {
namespace {

Bounds bounds_of(std::initializer_list<Vec3> points) {
  Bounds b{*points.begin(), *points.begin()};
  for (const Vec3& p : points) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
  }
  return b;
}

}  // namespace

Texture plain(const Vec3& colour) {
  return [colour](const Vec3&) { return colour; };
}

Rectangle::Rectangle(double x0, double y0, double x1, double y1, double depth, Texture texture)
    : x0_(x0), y0_(y0), x1_(x1), y1_(y1), depth_(depth), texture_(std::move(texture)) {}

bool Rectangle::intersect(const Ray& ray, Hit& hit) const {
  const double t = (depth_ - ray.origin.z) / ray.direction.z;
  if (!(t > ray.from && t < hit.t)) return false;
  const double x = ray.origin.x + t * ray.direction.x, y = ray.origin.y + t * ray.direction.y;
  if (x < x0_ || x >= x1_ || y < y0_ || y >= y1_) return false;
  hit = {t, texture_({x, y, 0}), {}};
  return true;
}

Bounds Rectangle::bounds() const { return {{x0_, y0_, depth_}, {x1_, y1_, depth_}}; }

Quad::Quad(const Vec3& corner, const Vec3& edge_a, const Vec3& edge_b, Texture texture, Kind kind)
    : corner_(corner),
      a_(normalized(edge_a)),
      b_(normalized(edge_b)),
      normal_(cross(a_, b_)),
      length_a_(length(edge_a)),
      length_b_(length(edge_b)),
      texture_(std::move(texture)),
      kind_(kind) {}

bool Quad::intersect(const Ray& ray, Hit& hit) const {
  const double slope = dot(normal_, ray.direction);
  const double t = dot(normal_, corner_ - ray.origin) / slope;
  if (!(t > ray.from && t < hit.t)) return false;  // a NaN, from a ray along it, misses
  const Vec3 p = ray.origin + ray.direction * t - corner_;
  const double a = dot(p, a_), b = dot(p, b_);
  if (a < 0 || a >= length_a_ || b < 0 || b >= length_b_) return false;
  const Vec3 normal = slope < 0 ? normal_ : -normal_;
  hit = {t, texture_({a, b, 0}), kind_ == Kind::lit ? normal : Vec3{}};
  return true;
}

Bounds Quad::bounds() const {
  const Vec3 a = a_ * length_a_, b = b_ * length_b_;
  return bounds_of({corner_, corner_ + a, corner_ + b, corner_ + a + b});
}

Ball::Ball(const Vec3& centre, double radius, Texture texture)
    : centre_(centre), radius_(radius), texture_(std::move(texture)) {}

bool Ball::intersect(const Ray& ray, Hit& hit) const {
  const Vec3& d = ray.direction;
  const Vec3 m = ray.origin - centre_;
  const double a = dot(d, d), b = dot(m, d), c = dot(m, m) - radius_ * radius_;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return false;
  const double t = (-b - std::sqrt(discriminant)) / a;
  if (!(t > ray.from && t < hit.t)) return false;
  const Vec3 n{(m.x + t * d.x) / radius_, (m.y + t * d.y) / radius_, (m.z + t * d.z) / radius_};
  hit = {t, texture_(n), n};
  return true;
}

Bounds Ball::bounds() const {
  const Vec3 r{radius_, radius_, radius_};
  return {centre_ - r, centre_ + r};
}

Lamp::Lamp(const Vec3& centre, double radius, const Vec3& radiance)
    : ball_(centre, radius, plain(radiance)) {}

bool Lamp::intersect(const Ray& ray, Hit& hit) const {
  if (!ball_.intersect(ray, hit)) return false;
  hit.normal = {};
  return true;
}

Box::Box(const Vec3& centre, const Vec3& half_size, double yaw, Texture texture)
    : centre_(centre),
      half_(half_size),
      cos_(std::cos(yaw)),
      sin_(std::sin(yaw)),
      texture_(std::move(texture)) {}

Vec3 Box::to_box(const Vec3& v) const {
  return {cos_ * v.x + sin_ * v.z, v.y, cos_ * v.z - sin_ * v.x};
}

Vec3 Box::from_box(const Vec3& v) const {
  return {cos_ * v.x - sin_ * v.z, v.y, cos_ * v.z + sin_ * v.x};
}

bool Box::intersect(const Ray& ray, Hit& hit) const {
  const Vec3 o = to_box(ray.origin - centre_), d = to_box(ray.direction);
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  Vec3 normal;
  // Kay & Kajiya 1986: inside a box is inside three slabs at once.
  const auto clip = [&](double at, double slope, double half, const Vec3& axis) {
    const double near = (std::copysign(half, -slope) - at) / slope;
    if (near > enter) {
      enter = near;
      normal = axis * (slope > 0 ? -1 : 1);
    }
    leave = std::min(leave, (std::copysign(half, slope) - at) / slope);
  };
  clip(o.x, d.x, half_.x, {1, 0, 0});
  clip(o.y, d.y, half_.y, {0, 1, 0});
  clip(o.z, d.z, half_.z, {0, 0, 1});
  if (enter > leave || !(enter > ray.from && enter < hit.t)) return false;
  hit = {enter, texture_(o + d * enter), from_box(normal)};
  return true;
}

Bounds Box::bounds() const {
  const double x = std::fabs(cos_) * half_.x + std::fabs(sin_) * half_.z;
  const double z = std::fabs(cos_) * half_.z + std::fabs(sin_) * half_.x;
  return {centre_ - Vec3{x, half_.y, z}, centre_ + Vec3{x, half_.y, z}};
}

}  // namespace defray
