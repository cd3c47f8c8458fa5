#pragma once
// Geometric against diffraction PSF, in pixels: the figures, a chart and a table.
#include <functional>
#include <string>
#include <vector>

#include "lens/lens.h"
#include "measure/plot.h"

namespace defray {

/// The diffraction PSF at one wavelength.
struct PsfCurve {
  double wavelength_nm = 0;
  double airy_diameter_um = 0;  ///< Of the first dark ring in focus, on the sensor.
  double airy_diameter_px = 0;
  double energy_outside = 0;  ///< Share beyond the geometric disc's radius plus one pixel.
  std::vector<double> density_per_px2;
};

/// Radial PSFs as energy per square pixel, the whole energy being 1.
struct PsfReport {
  double coc_diameter_px = 0;  ///< Geometric; 0 in focus.
  double pixel_um = 0;
  double fresnel_zones = 0;  ///< At the shortest wavelength.
  /// From 0, equally spaced. At most 500: of many fringes a chart shows samples only.
  std::vector<double> radii_px;
  std::vector<double> geometric_per_px2;  ///< The uniform disc; all 0 where it is a point.
  std::vector<double> broadband_per_px2;  ///< Mean over the band that the wavelengths span.
  std::vector<PsfCurve> monochrome;       ///< Of each wavelength, as given.
  /// The Airy diameter exceeds both a pixel and the CoC diameter, or more than 10 % of the energy
  /// is outside (`energy_outside`), at any of the wavelengths.
  bool diffraction_matters = false;
};

/// PSFs of a point at planar `depth_units`, of a lens taken as LensModel::breathing. Throws
/// Error(usage) as image_of_point and DiffractionPsf do, and on no wavelength or one outside 100 to
/// 20000 nm. `progress` gets the share done, 0 to 1.
PsfReport measure_psf(const Lens& lens, double depth_units, int width_px,
                      const std::vector<double>& wavelengths_nm,
                      const std::function<void(double)>& progress = {});

/// The curves over the radius in pixels, with half a pixel marked. `is_log`: log10 densities, of
/// which those below 1e-6 of the diffraction PSFs' largest are drawn there.
Plot psf_plot(const PsfReport& report, bool is_log);

/// A row a radius: radius_px, radius_um, geometric, broadband, and each wavelength.
/// Throws Error(output).
void write_psf_csv(const std::string& path, const PsfReport& report);

}  // namespace defray
