#pragma once
// The shapes that the built-in scenes are made of.
#include <functional>

#include "scenes/geometry/primitive.h"

namespace defray {

/// Colour at a point in the shape's own coordinates.
using Texture = std::function<Vec3(const Vec3&)>;

/// Every point in one colour.
Texture plain(const Vec3& colour);

/// A rectangle parallel to the picture plane, unlit. Its texture gets (x, y, 0).
class Rectangle : public Primitive {
 public:
  Rectangle(double x0, double y0, double x1, double y1, double depth, Texture texture);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  double x0_, y0_, x1_, y1_, depth_;
  Texture texture_;
};

/// A rectangle in any position: a corner and two edges at right angles. Its texture gets the
/// distances along both edges: (along a, along b, 0). Both faces look alike.
class Quad : public Primitive {
 public:
  enum class Kind { lit, unlit };
  Quad(const Vec3& corner, const Vec3& edge_a, const Vec3& edge_b, Texture texture,
       Kind kind = Kind::lit);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  Vec3 corner_, a_, b_, normal_;
  double length_a_, length_b_;
  Texture texture_;
  Kind kind_;
};

/// A sphere; its texture gets the point on the unit sphere.
class Ball : public Primitive {
 public:
  Ball(const Vec3& centre, double radius, Texture texture);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  Vec3 centre_;
  double radius_;
  Texture texture_;
};

/// A sphere that gives off light evenly.
class Lamp : public Primitive {
 public:
  Lamp(const Vec3& centre, double radius, const Vec3& radiance);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override { return ball_.bounds(); }

 private:
  Ball ball_;
};

/// A box standing upright, turned by `yaw` radians; its texture gets the point relative to the
/// centre, in the box's axes.
class Box : public Primitive {
 public:
  Box(const Vec3& centre, const Vec3& half_size, double yaw, Texture texture);
  bool intersect(const Ray& ray, Hit& hit) const override;
  Bounds bounds() const override;

 private:
  Vec3 to_box(const Vec3& v) const;
  Vec3 from_box(const Vec3& v) const;
  Vec3 centre_, half_;
  double cos_, sin_;
  Texture texture_;
};

}  // namespace defray
