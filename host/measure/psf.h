#pragma once
// The point spread function of a thin lens: geometric optics against diffraction.
#include <complex>
#include <vector>

#include "lens/lens.h"

namespace defray {

/// A point on the axis and the lens that images it, in metres.
struct PointImage {
  double aperture_radius_m = 0;  ///< R.
  double sensor_distance_m = 0;  ///< z_s, from 1/z_s = 1/f - 1/focus.
  double defocus_per_m = 0;      ///< alpha = 1/z_o + 1/z_s - 1/f = 1/z_o - 1/focus, signed.
  double pixel_m = 0;            ///< Width of a pixel on the sensor.
};

/// The image of a point at planar `depth_units` (inf is allowed), as a camera of
/// LensModel::breathing takes it. Throws Error(usage) on a lens that `validate` refuses, an
/// aperture of 0, a depth that is not above 0, and a width outside 1...65536 pixels.
PointImage image_of_point(const Lens& lens, double depth_units, int width_px);

/// Radius of the geometric PSF, a uniform disc: R |alpha| z_s (Shinya 1994, eq. 2 and 3).
double geometric_radius_m(const PointImage& image);

/// Radius of the first dark ring in focus: 1.22 lambda N, N = z_s / (2 R) the working f-number.
double airy_radius_m(const PointImage& image, double wavelength_m);

/// How often the wave's phase turns by pi over the aperture: alpha R^2 / lambda.
double fresnel_zones(const PointImage& image, double wavelength_m);

/// The diffraction PSF of a circular aperture, monochrome: Shinya 1994, eq. 4, whose integral over
/// the disc is in polar coordinates, with s = rho / R,
///   U(r) = 2 int_0^1 exp(i pi alpha R^2 s^2 / lambda) J0(2 pi R s r / (lambda z_s)) s ds.
/// Scalar, paraxial (Fresnel), without aberrations.
class DiffractionPsf {
 public:
  /// For radii up to `largest_radius_m`: doubles the nodes of the integral (Gauss-Legendre panels)
  /// until U on axis and at that radius, where the integrand turns fastest, changes by less than
  /// 1e-10. Throws Error(usage) where 32768 nodes are not enough.
  DiffractionPsf(const PointImage& image, double wavelength_m, double largest_radius_m);

  /// |U|^2: 1 on axis in focus.
  double intensity(double radius_m) const;

  /// The same as a density: energy per square metre of a point's image of energy 1.
  double density_per_m2(double radius_m) const { return density_in_focus_ * intensity(radius_m); }

  /// Share of the energy within a radius, up to the largest one; tends to 1.
  double encircled_energy(double radius_m) const;

 private:
  void set_panels(int panels);
  std::complex<double> amplitude(double radius_m) const;

  double phase_;               ///< pi alpha R^2 / lambda, at the aperture's rim.
  double v_per_m_;             ///< 2 pi R / (lambda z_s): from radius to J0's argument at the rim.
  double density_in_focus_;    ///< pi R^2 / (lambda z_s)^2.
  std::vector<double> nodes_;  ///< s.
  std::vector<std::complex<double>> factors_;  ///< All but J0, weight included.
};

}  // namespace defray
