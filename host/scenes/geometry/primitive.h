#pragma once
// What rays of the built-in scenes can hit.
#include "base/vec3.h"

namespace defray {

/// Points origin + t direction with t > from. Rays of the camera have direction.z = 1 and start on
/// the plane of the lens, z = 0: their t is the planar depth.
struct Ray {
  Vec3 origin, direction;
  double from = 0;
};

class Emitter;

/// Where a ray enters an object.
struct Hit {
  double t = 0;
  Vec3 colour;  ///< Linear reflectance; where `normal` is zero, light given off.
  Vec3 normal;  ///< Unit length, towards the ray's origin.
  const Emitter* emitter = nullptr;  ///< What was hit, where it is one.
};

/// An axis-aligned box.
struct Bounds {
  Vec3 low, high;
};

/// Something that a ray can hit. The camera is at the origin and looks along +z; x is right, y
/// down; units are the scene's.
class Primitive {
 public:
  virtual ~Primitive() = default;
  /// The first point, with ray.from < t < hit.t, where the ray enters the primitive from outside.
  /// Leaves `hit` alone and returns false where there is none.
  virtual bool intersect(const Ray& ray, Hit& hit) const = 0;
  /// A box around all that can be hit.
  virtual Bounds bounds() const = 0;
};

}  // namespace defray
