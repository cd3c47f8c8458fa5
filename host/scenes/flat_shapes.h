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

/// A small disc that gives off light evenly. What it adds to a truth is found by aiming at it: a
/// ray that leaves the lens at random hardly ever meets it.
class Emitter : public Primitive {
 public:
  Emitter(const Vec3& centre, double radius, const Vec3& radiance);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override { return disc_.bounds(); }

  const Vec3& centre() const { return centre_; }
  double radius() const { return radius_; }
  const Vec3& radiance() const { return radiance_; }

 private:
  Vec3 centre_;
  double radius_;
  Vec3 radiance_;
  Disc disc_;
};

/// A point of the unit disc, area-preserving (Shirley & Chiu 1997 in polar form).
std::array<double, 2> disc_point(double s, double t);

/// Share of the unit disc that a disc of this radius covers whose centre is `distance` away.
double disc_overlap(double distance, double radius);

}  // namespace defray
