#pragma once
// Flat shapes parallel to the picture plane, and lights that renderers can aim at.
#include <array>
#include <vector>

#include "scenes/primitives.h"

namespace defray {

/// A disc, unlit. Its texture gets (x, y, 0).
class Disc : public Primitive {
 public:
  Disc(const Vec3& centre, double radius, Texture texture);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  Vec3 centre_;
  double radius_;
  Texture texture_;
};

/// A polygon of any form, even-odd where its sides cross, unlit. Its texture gets (x, y, 0).
class Polygon : public Primitive {
 public:
  Polygon(std::vector<std::array<double, 2>> corners, double depth, Texture texture);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  std::vector<std::array<double, 2>> corners_;
  double depth_;
  Texture texture_;
};

/// A small shape that gives off light evenly. What it adds to a truth is found by aiming at it: a
/// ray that leaves the lens at random hardly ever meets it.
class Emitter : public Primitive {
 public:
  enum class Shape { disc, square };
  /// `half_size` is the radius, or half a side.
  Emitter(const Vec3& centre, double half_size, Shape shape, const Vec3& radiance);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

  const Vec3& centre() const { return centre_; }
  double half_size() const { return half_size_; }
  const Vec3& radiance() const { return radiance_; }
  double area() const;
  /// A point of the shape, for s and t in [0, 1); area-preserving.
  Vec3 point(double s, double t) const;

 private:
  Vec3 centre_;
  double half_size_;
  Shape shape_;
  Vec3 radiance_;
};

/// A point of the unit disc, area-preserving (Shirley & Chiu 1997 in polar form).
std::array<double, 2> disc_point(double s, double t);

}  // namespace defray
