#pragma once
// Depth that was stored in half floats comes in steps; where the lens makes a step larger than half
// of what parts surfaces (3/8 px), they show as rings.
#include <cstddef>

#include "base/plane.h"
#include "lens/lens.h"

namespace defray {

struct HalfSteps {
  double largest_px = 0;     ///< By how much the CoC changes at a step of what is seen.
  std::size_t smoothed = 0;  ///< Pixels whose depth was changed, by half a step at the most.
};

/// Where depths are half floats and a step at a depth that is seen changes the CoC by more than
/// 3/8 of a pixel: terraces become slopes, between the middles of their steps, and slopes that are
/// steeper than a step a pixel (half_slopes.h) lose what rounding put on them. Level surfaces stay,
/// and nothing is smoothed across an edge. `depth` is planar, `lens_width` the frame that the lens
/// spans.
HalfSteps smooth_half_steps(Plane& depth, int width, const Lens& lens, int lens_width);

}  // namespace defray
