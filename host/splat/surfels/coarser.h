#pragma once
// Where points begin to lie closer together.
#include <array>
#include <vector>

#include "splat/surfels/neighbours.h"

namespace defray {

/// The nearest of a point in the last row before finer ones are these alone: the coarser points
/// beside it, which have it around them, take the places of up to half of them.
void add_coarser(const std::vector<std::array<float, 3>>& places, Neighbours& around);

}  // namespace defray
