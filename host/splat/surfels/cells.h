#pragma once
// How far the surface that a point stands for reaches around it.
#include <array>
#include <cstdint>
#include <vector>

#include "splat/surfels/cloud_points.h"

namespace defray {

/// Two axes across a normal.
struct TangentAxes {
  Vec3 u, v;
};
TangentAxes axes_across(const Vec3& normal);

/// Directions on a tangent plane in which sums of basis functions are looked at, evenly around a
/// point from its first axis on.
struct Direction {
  double x, y;
};
const std::array<Direction, site_count>& site_directions();

/// Finds where surfaces end, how far away sums of basis functions must be looked at, and makes
/// spacings that are estimated larger beside gaps, so that basis functions reach into them.
void find_cells(CloudPoints& cloud, const std::vector<std::uint8_t>& has_radius);

}  // namespace defray
