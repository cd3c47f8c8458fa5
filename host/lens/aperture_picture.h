#pragma once
// A picture of the bokeh as an aperture.
#include "lens/aperture_mask.h"

namespace defray {

/// The mask of aperture.image. Throws Error(input).
ApertureMask rasterise_picture(const Aperture& aperture);

}  // namespace defray
