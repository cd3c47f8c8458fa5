#pragma once
// What a view shows of surfaces with one side.
#include "defray/splat.h"
#include "frame/values.h"
#include "kernels/splat_params.h"

namespace defray {

/// Sets from_behind and is_inside_out.
void describe_sides(const Values<DefraySplatNode>& nodes, const DefraySplatParams& p,
                    SplatReport& report);

}  // namespace defray
