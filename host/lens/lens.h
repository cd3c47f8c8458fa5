#pragma once
// The thin lens: physical units in, constants of the circle of confusion out.
#include <cstdint>

#include "defray/lens.h"
#include "kernels/params.h"

namespace defray {

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
