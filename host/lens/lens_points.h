#pragma once
// Lens points: where rays go through the aperture. A ray distribution buffer has a cell for each.
#include <array>
#include <cstdint>
#include <vector>

#include "defray/lens.h"

namespace defray {

/// Lens coordinates are integers, 2^-16 of the aperture radius: kernel and twin share them exactly.
struct LensPoints {
  std::vector<std::array<std::int32_t, 2>> points;  ///< (u, v)
  /// How far each pixel moves each of them at most: half a cell of a grid; 0 without jitter.
  std::int32_t jitter = 0;
  /// Of CoC radii below 1 px, the ones as which their rays land (landing_radii.h), in quanta.
  /// Empty: their own, as with jitter.
  std::vector<std::int32_t> landing_radii = {};
};

inline constexpr int most_lens_points = 4096;

/// Exactly `count` points, without jitter, the light's share around each alike. |u| and |v| are at
/// most 1; points of an iris lie within its shape. Throws Error(usage) unless
/// 1 <= count <= most_lens_points, and what rasterise throws.
///
/// An iris: Vogel's spiral ("A better way to construct the sunflower head", 1979) with two arms, so
/// that points come as antipodal pairs (an odd count begins with the centre) and their mean is 0:
/// pair k at radius sqrt((2 k + 1) / count) and k times half the golden angle. Angles are taken as
/// shares of the iris's area and radii as shares of the way to its edge, which keeps areas. From
/// 60 on, their columns, and their rows, are moved to where equal shares of the area have their
/// middles, as far as the shape goes: upright and level edges blur to within a point or so, where a
/// spiral is off by 3 of 137. Second moments are right to 2 / count of their sum. A picture: the
/// lattice
/// ((k + 1/2) / count, k times the golden ratio), point-symmetric, through the light's distribution
/// over columns and, within a column, over its texels.
///
/// The mean is the shape's: but for rounding where the shape is point-symmetric; else to
/// 1 / (2 count) of the aperture radius (blades), 1 / count or so (pictures; noise: to 4 / count).
LensPoints make_lens_points(const Aperture& aperture, int count);

}  // namespace defray
