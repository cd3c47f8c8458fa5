#pragma once
// Planes of half the size at full size again, with what of the finest detail is to be seen.
#include "chain/half_frame.h"

namespace defray {

/// A plane of ((width + 1) / 2) x ((height + 1) / 2) values at width x height: linear between the
/// middles of blocks.
Plane at_full_size(const Plane& half, int width, int height);

/// `results`, those of the frame's first channels at half the size, at full size, with the detail
/// that the frame has beside the clear pixels of the half frame, by `visible` of it; nothing darker
/// than black, and nothing that is not a number.
std::vector<Plane> with_detail(const Frame& frame, const HalfFrame& half,
                               const std::vector<Plane>& results, const Plane& visible);

}  // namespace defray
