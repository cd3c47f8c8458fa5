#pragma once
// Which side of estimated normals is outside.
#include <cstdint>

#include "base/vec3.h"
#include "splat/hierarchy.h"

namespace defray {

struct CloudPoints;

/// Where a surface's outside is known from: its points' normals, or that it is closed.
enum class Outside : std::uint32_t { unknown, given, found };

/// Turns estimated normals so that neighbours' agree, and outwards where a surface is closed (Hoppe
/// et al. 1992). Returns whether nearly all points are of closed ones: the others then
/// are two-sided, and if not, none has an outside.
bool find_sides(CloudPoints& cloud);

/// Whether a closed surface lies all around a place: its winding number there is above 1/2.
bool is_within(const Hierarchy& tree, const Vec3& place);

}  // namespace defray
