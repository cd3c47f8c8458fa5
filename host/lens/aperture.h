#pragma once
// The aperture: the shape of the hole that light passes, and so of every out-of-focus highlight.
//
// Lens coordinates (u, v): 1 is the radius of the circle that the f-number speaks of; u points
// right, v down, as in the picture. A point p with a CoC of signed radius r lights x = p + r (u,
// v): behind the plane of focus (r > 0) the aperture shows upright, in front of it turned by 180
// degrees.
#include <string>

namespace defray {

/// Every shape lies within the unit disc (a picture: the square around it) and touches it: an iris
/// of blades lets less light through than the circle around it, as in Cycles and Arnold. The
/// picture does not get darker: a method divides by the light of the whole shape.
struct Aperture {
  /// 0: a circle; else corners of a regular polygon, 3 to 32.
  int blades = 0;
  /// Of the blades' edges, arcs through two corners: 0 straight, 1 the circle, below 0 hollow, to
  /// -1 (the circle's arc mirrored; from 4 blades on, fewer would overlap). Arnold's blade
  /// curvature.
  double curvature = 0;
  /// Of the iris, counter-clockwise in the picture behind the focus; at 0 the middle of a blade is
  /// on the right, as in Cycles.
  double rotation_deg = 0;
  /// Height of the shape over its width, 0.125 to 8, after rotation; the longer side keeps its
  /// size. 2 is the upright oval of a 2x anamorphic lens. Cycles and Blender call it the ratio.
  double squeeze = 1;
  /// A picture of the bokeh instead of blades (.png, .exr, ...), in linear light; its longer side
  /// spans the square, so that the picture as it is shows behind the focus.
  std::string image;
  /// Optical vignetting, 0 to 1: how far, at the frame's corner, the lens rim's circle is from the
  /// aperture's, in its radii (cats_eye.h).
  double cats_eye = 0;

  bool operator==(const Aperture&) const = default;
};

/// Throws Error(usage) on values that are not allowed, or that go not together.
void validate(const Aperture& aperture);

}  // namespace defray
