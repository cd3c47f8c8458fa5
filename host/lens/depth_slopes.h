#pragma once
// Depth that was stored in steps, on slopes as steep as a step a pixel, or steeper.
#include "lens/depth_ladder.h"

namespace defray {

/// The depth of each pixel on such a slope, half a step at the most from what is stored: on the
/// line that goes through it and its neighbours, all within their rounding, across or down. 0
/// elsewhere. What lies beyond an edge is on no such line.
Plane smoothed_slopes(const DepthLadder& ladder, int width);

}  // namespace defray
