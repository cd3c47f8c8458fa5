#pragma once
// Cat's-eye vignetting: the rim of the lens cuts off a part of the aperture, the more the farther
// from the frame's centre.
#include <array>
#include <cstdint>

namespace defray {

/// Centre of the rim's circle in lens coordinates, 2^-16 of the aperture radius.
using RimCentre = std::array<std::int32_t, 2>;

/// Two circles of the aperture's radius (squeezed or not): light passes where both are open. Seen
/// from field position f, a vector from the frame's centre that is 1 long at its corners, the rim
/// is off by -strength f: a rim in front of the aperture shadows it on the side that the light
/// comes from. In the picture the highlight loses its outer side behind the focus and its inner
/// side in front of it; what is left is a lens shape across the line to the centre.
/// `strength` is Aperture::cats_eye; pixel centres are at x + 1/2; a frame is 1 pixel or more.
RimCentre rim_centre(double strength, double x, double y, int width, int height);

/// Whether light passes the rim at (u, v), 2^-16 of the aperture radius. Not to be asked without
/// vignetting: a picture's corners are outside a rim in the middle, too.
bool passes_rim(const RimCentre& rim, std::int32_t u, std::int32_t v);

}  // namespace defray
