#pragma once
// Which side of estimated normals is outside.
#include "base/vec3.h"
#include "splat/hierarchy.h"

namespace defray {

struct CloudPoints;

/// Turns estimated normals so that neighbours' agree, and outwards where a surface is closed (Hoppe
/// et al. 1992). Points of all others are two-sided.
void find_sides(CloudPoints& cloud);

/// Whether a closed surface lies all around a place: the winding number there of what has one side
/// is above 1/2.
bool is_within(const Hierarchy& tree, const Vec3& place);

}  // namespace defray
