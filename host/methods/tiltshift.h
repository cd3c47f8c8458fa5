#pragma once
// The tilt-shift baseline: a vertical blur gradient that knows no depth (Glatzel & Wilhelm, fig.
// 2).
#include "defray/options.h"
#include "kernels/methods_params.h"

namespace defray {

/// Throws Error(usage) on a band outside the frame or a radius that `linear` does not take.
void validate(const TiltshiftSettings& settings);

/// The gradient as the kernel reads it. Data rows begin `first_row` rows below the display
/// window's top, which is `display_height` high.
DefrayTiltshiftParams tiltshift_params(const TiltshiftSettings& settings, int width, int rows,
                                       int first_row, int display_height);

}  // namespace defray
