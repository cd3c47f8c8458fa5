#pragma once
// Nodes of a point cloud, and a camera before them, from a case.
#include <vector>

#include "kernels/splat_params.h"
#include "validation/case.h"

namespace defray::validation {

/// A node for every fourth pixel or so, to 2000: flat and thick ones, some seen from behind, too
/// near or beside the picture, without area, or many in one place.
std::vector<DefraySplatNode> splat_nodes(const Case& c);

DefraySplatParams splat_params(const Case& c);

}  // namespace defray::validation
