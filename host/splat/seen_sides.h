#pragma once
// What is seen of surfaces with one side, and from where.
#include "base/vec3.h"
#include "defray/splat.h"
#include "frame/values.h"
#include "kernels/splat_params.h"
#include "splat/hierarchy.h"

namespace defray {

/// Sets from_behind and is_inside_out.
void describe_sides(const Values<DefraySplatNode>& nodes, const DefraySplatParams& p,
                    SplatReport& report);

/// Whether a closed surface lies all around a place: the winding number there of what has one side
/// is above 1/2.
bool is_within(const Hierarchy& tree, const Vec3& place);

}  // namespace defray
