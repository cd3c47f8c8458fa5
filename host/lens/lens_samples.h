#pragma once
// Sample points on an aperture of any shape: the cells of a ray distribution buffer.
#include "lens/aperture.h"
#include "lens/aperture_mask.h"
#include "lens/lens_cells.h"

namespace defray {

inline constexpr int lens_samples_max_count = 4096;

/// Exactly `count` points, without jitter, the light's share around each alike. |u| and |v| are at
/// most 1; points of an iris lie within its shape. Throws Error(usage) unless
/// 1 <= count <= lens_samples_max_count, and what rasterise throws.
///
/// An iris: Vogel's spiral ("A better way to construct the sunflower head", 1979) with two arms, so
/// that points come as antipodal pairs (an odd count begins with the centre) and their mean is 0:
/// pair k at radius sqrt((2 k + 1) / count) and k times half the golden angle. Angles are taken as
/// shares of the iris's area and radii as shares of the way to its edge, which keeps areas.
/// Second moments are right to 2 / count of their sum.
/// A picture: the lattice ((k + 1/2) / count, k times the golden ratio), point-symmetric, through
/// the light's distribution over columns and, within a column, over its texels.
///
/// The mean is the shape's: but for rounding where the shape is point-symmetric; else to
/// 1 / (2 count) of the aperture radius (blades), 1 / count or so (pictures; noise: to 4 / count).
LensCells make_lens_samples(const Aperture& aperture, int count);

}  // namespace defray
