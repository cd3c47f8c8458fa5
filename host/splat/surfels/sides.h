#pragma once
// Which side of estimated normals is outside.
namespace defray {

struct CloudPoints;

/// Turns estimated normals so that neighbours' agree, and outwards where a surface is closed (Hoppe
/// et al. 1992). Points of all others are two-sided.
void find_sides(CloudPoints& cloud);

}  // namespace defray
