#pragma once
// The lens whose PSF tests look at, and its image of a point.
#include "measure/psf.h"
#include "support.h"

namespace defray::test {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double green = 550e-9;

inline Lens lens_of(double focus, double fstop) {
  Lens lens;
  lens.aperture_diameter_mm = lens.focal_length_mm / fstop;
  lens.focus_distance_units = focus;
  lens.model = LensModel::breathing;
  return lens;
}

inline PointImage image_of(double depth, double focus = 3, double fstop = 2.8) {
  return image_of_point(lens_of(focus, fstop), depth, 1920);
}

/// From a radius to the argument of the Airy pattern.
inline double v_of(const PointImage& image, double radius) {
  return 2 * pi * image.aperture_radius_m * radius / (green * image.sensor_distance_m);
}

}  // namespace defray::test
