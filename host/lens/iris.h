#pragma once
// The geometry of an iris: a circle, or blades whose edges are arcs. No picture, no squeeze.
#include <array>
#include <vector>

#include "lens/aperture.h"

namespace defray {

/// With x along a blade's middle, from the centre outward, an edge is where
///   t + bend/2 (t^2 + y^2) = 0,  t = x - apothem,
/// inside where this is below 0: a line for bend 0, a circle of radius 1/bend else.
class Iris {
 public:
  /// Of a valid aperture's blades, curvature and rotation.
  explicit Iris(const Aperture& aperture);

  /// How far a point of the unit disc is beyond the edge of the nearest blades: below 0 inside,
  /// near the edge a distance; elsewhere its slope is at most `steepest`.
  double beyond_edge(double u, double v) const;
  static constexpr double steepest = 3;

  /// A share 0...1 of the iris's area, as an angle from its centre -> that angle, radians
  /// (clockwise in the picture: v points down), and how far the edge is there.
  struct Edge {
    double angle, radius;
  };
  Edge edge_at_share(double share) const;

 private:
  double radius_at(double angle_from_middle) const;

  int blades_;
  std::vector<std::array<double, 2>> middles_;  ///< Directions of the blades' middles.
  double rotation_ = 0;       ///< Radians, of the first blade's middle, clockwise.
  double apothem_ = 1;        ///< Centre to the middle of an edge.
  double bend_ = 1;           ///< 1 / radius of the edges; below 0: hollow.
  std::vector<double> area_;  ///< Of half a blade up to steps of its angle, 0...1.
};

}  // namespace defray
