#pragma once
// The tilt-shift baseline: a vertical blur gradient that knows no depth (Glatzel & Wilhelm, fig.
// 2).
#include "kernels/params.h"

namespace defray {

/// Lengths in heights of the display window, from its top.
struct TiltshiftSettings {
  double band_centre = 0.5;  ///< 0 to 1.
  double band_width = 0.2;   ///< Height of the sharp band, 0 to 1.
  double max_blur_px = 9.2;  ///< Radius at the frame's edge that is farthest from the band.
};

/// Throws Error(usage) on a band outside the frame or a radius that `linear` does not take.
void validate(const TiltshiftSettings& settings);

/// The gradient as the kernel reads it. Data rows begin `first_row` rows below the display
/// window's top, which is `display_height` high.
DefrayTiltshiftParams tiltshift_params(const TiltshiftSettings& settings, int width, int rows,
                                       int first_row, int display_height);

}  // namespace defray
