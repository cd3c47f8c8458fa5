#pragma once
// Rays of small circles of confusion, rounded to whole pixels.
//
// Rounded as they are, rays of a CoC below half a pixel all stay in their pixel and do not blur it;
// a little beyond too few leave it. So they land as if they had another radius: the one of whose
// rays so many leave that the picture's fine detail fades as it does under the true disc.
#include <cstdint>
#include <vector>

#include "lens/lens_points.h"

namespace defray {

/// For each radius below 1 px, in quanta, the one whose rays land in its place: 0 and up to 1 px,
/// never falling. With it the mean over both axes of what is left of cosines of 0.4 cycles a pixel
/// is nearest to what the lens points leave of them unrounded, of all radii up to 1 px.
///
/// 0.4 was chosen on built-in scenes of 640x400 (slanted, spheres, blocks-forest, lines, drift):
/// 0.3 loses up to 0.1 dB, and textures look sharper than the truth's (false edges of `slanted` 0.9
/// instead of 0.4); 0.45 loses up to 0.13 dB, 0.5 0.5 dB on blocks-forest and 0.36 on lines.
std::vector<std::int32_t> landing_radii(const LensPoints& lens);

/// A signed radius' own, in quanta, if it has none.
std::int64_t landing_radius(const LensPoints& lens, std::int64_t radius);

/// The least signed radius that lands as `landing` or as a larger one does.
std::int64_t first_landing_as(const LensPoints& lens, std::int64_t landing);

}  // namespace defray
