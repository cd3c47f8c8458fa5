#pragma once
// Emitters as truths aim at them.
#include <array>
#include <cmath>

#include "scenes/geometry/flat_shapes.h"
#include "scenes/tracing/tracer.h"

namespace defray {

/// An emitter's image on the lens: where the rays that meet it leave through a point of the
/// picture. It is a disc, too. Lengths are in radii of the lens.
class Target {
 public:
  Target(const Scene& scene, const Lens& lens, const Emitter& emitter)
      : emitter_(&emitter),
        scale_(1 / (1 - emitter.centre().z / lens.focus_distance_units) / aperture_radius(lens)),
        radius_(std::fabs(scale_) * emitter.radius()),
        pixel_reach_(std::fabs(scale_) * emitter.centre().z / pixel_focal_length(scene)) {}

  const Emitter* emitter() const { return emitter_; }
  double radius() const { return radius_; }
  /// Aiming pays where the image is smaller than the lens.
  bool pays() const { return radius_ < 1; }

  /// The image's centre.
  std::array<double, 2> centre(const Ray& pinhole) const {
    const Vec3 off = emitter_->centre() - pinhole.direction * emitter_->centre().z;
    return {off.x * scale_, off.y * scale_};
  }

  /// False where no point of the pixel can see the emitter.
  bool is_near(const Ray& pixel_centre) const {
    const auto [u, v] = centre(pixel_centre);
    return std::hypot(u, v) <= 1 + radius_ + pixel_reach_;
  }

 private:
  const Emitter* emitter_;
  double scale_, radius_;
  double pixel_reach_;  ///< How far a pixel's width moves the image.
};

/// A point that both the lens and a disc before it have: the disc's own point at `in_disc` (unit
/// disc), else the middle of what they share.
inline std::array<double, 2> shared_point(const std::array<double, 2>& centre, double radius,
                                          const std::array<double, 2>& in_disc) {
  const auto [u, v] = centre;
  const std::array<double, 2> point{u + radius * in_disc[0], v + radius * in_disc[1]};
  if (std::hypot(point[0], point[1]) <= 1) return point;
  const double d = std::hypot(u, v);
  const double middle = (std::fmax(-1, d - radius) + std::fmin(1, d + radius)) / 2;
  return {u / d * middle, v / d * middle};
}

}  // namespace defray
