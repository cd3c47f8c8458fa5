#pragma once
// Depth in half floats on slopes as steep as a step a pixel, or steeper.
#include <cstddef>
#include <vector>

#include "base/plane.h"

namespace defray {

/// A float's next neighbour among half floats, away from 0.
float next_half(float z);

/// The depth of each pixel on such a slope, half a step at the most from what is stored: on the
/// line that goes through it and its neighbours, all within their rounding, across or down. 0
/// elsewhere. What lies beyond an edge is on no such line.
Plane smoothed_slopes(const Plane& depth, int width);

}  // namespace defray
