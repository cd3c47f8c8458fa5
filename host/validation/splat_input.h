#pragma once
// Nodes of a point cloud, and a camera before them, from a case.
#include <vector>

#include "kernels/splat_params.h"
#include "validation/case.h"

namespace defray::validation {

/// Nodes, and the ridges that some name.
struct SplatInput {
  std::vector<DefraySplatNode> nodes;
  std::vector<DefraySplatRidge> ridges;
};

/// A node for every fourth pixel or so, to 2000: flat and thick ones, some seen from behind, too
/// near or beside the picture, without area, or many in one place; of the flat ones most with
/// ridges.
SplatInput splat_input(const Case& c);

DefraySplatParams splat_params(const Case& c);

}  // namespace defray::validation
