#pragma once
// The thin lens: physical units in, constants of the circle of confusion out.
#include <cstdint>

#include "kernels/params.h"

namespace defray {

/// Which picture the pinhole frame is.
enum class LensModel {
  cg,         ///< Field of view fixed by the focal length; a renderer's thin-lens camera.
  breathing,  ///< Textbook camera: image distance, and with it the field of view, follows focus.
};

struct Lens {
  double focal_length_mm = 50;
  double aperture_diameter_mm = 50 / 2.8;
  double sensor_width_mm = 36;
  /// Pixels per metre of image plane, whatever the frame's width; 0: from the sensor width.
  double pixels_per_metre = 0;
  double focus_distance_units = 0;  ///< Planar, scene units; infinity is allowed.
  double metres_per_unit = 1;       ///< Scene unit.
  double max_coc_px = 0;            ///< Limit of the radius; 0: none.
  LensModel model = LensModel::cg;
};

/// Throws Error(usage) on values that no lens has, focus inside the focal length included.
void validate(const Lens& lens);

/// Focal length of the pinhole picture, in pixels, for a frame whose display window is
/// `display_width_px` wide.
double pixel_focal_length(const Lens& lens, int display_width_px);

/// Background CoC radius K in pixels (0 for focus at infinity): coc(z) = K (z - z0) / z.
double background_coc_px(const Lens& lens, int display_width_px);

/// The numerator of the CoC for focus at infinity, px x scene units: coc(z) = -scale / z.
double infinite_focus_scale(const Lens& lens, int display_width_px);

/// The same constants, as the kernel reads them.
DefrayCocParams coc_params(const Lens& lens, int display_width_px, std::uint32_t pixel_count);

}  // namespace defray
