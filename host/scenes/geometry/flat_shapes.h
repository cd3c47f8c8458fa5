#pragma once
// Flat shapes parallel to the picture plane, and lights that renderers can aim at.
#include <array>
#include <vector>

#include "scenes/geometry/primitives.h"

namespace defray {

/// A shape of one colour, unlit.
class FlatShape : public Primitive {
 public:
  FlatShape(double depth, const Vec3& colour) : depth_(depth), colour_(colour) {}
  bool intersect(const Ray& ray, Hit& hit) const override;
  double depth() const { return depth_; }
  const Vec3& colour() const { return colour_; }
  /// Adds where the line at height y enters and leaves the shape, ascending.
  virtual void add_crossings(double y, std::vector<double>& xs) const = 0;

 protected:
  virtual bool contains(double x, double y) const = 0;

 private:
  double depth_;
  Vec3 colour_;
};

class Disc : public FlatShape {
 public:
  Disc(const Vec3& centre, double radius, const Vec3& colour);
  Bounds bounds() const override;
  void add_crossings(double y, std::vector<double>& xs) const override;

 protected:
  bool contains(double x, double y) const override;

 private:
  Vec3 centre_;
  double radius_;
};

/// A polygon of any form, even-odd where its sides cross.
class Polygon : public FlatShape {
 public:
  Polygon(std::vector<std::array<double, 2>> corners, double depth, const Vec3& colour);
  Bounds bounds() const override;
  void add_crossings(double y, std::vector<double>& xs) const override;

 protected:
  bool contains(double x, double y) const override;

 private:
  template <typename Visit>
  void for_each_crossing(double y, const Visit& visit) const;

  std::vector<std::array<double, 2>> corners_;
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
