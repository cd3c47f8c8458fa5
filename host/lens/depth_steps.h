#pragma once
// Depth that was stored in half floats or whole numbers comes in steps; where the lens makes a step
// larger than half of what parts surfaces (3/8 px), they show as rings, or as surfaces of their
// own.
#include <cstddef>

#include "lens/depth_ladder.h"
#include "lens/lens.h"

namespace defray {

struct DepthSteps {
  double largest_px = 0;     ///< By how much the CoC changes at a step of what is seen.
  std::size_t smoothed = 0;  ///< Pixels whose depth was changed, by half a step at the most.
};

/// Where a step at a depth that is seen changes the CoC by more than 3/8 of a pixel: terraces
/// become slopes, between the middles of their steps, and slopes that are steeper than a step a
/// pixel (depth_slopes.h) lose what rounding put on them. Level surfaces stay, and nothing is
/// smoothed across an edge. `depth` is planar, of what `ladder` holds or of distances, `lens_width`
/// the frame that the lens spans. An empty ladder changes nothing.
DepthSteps smooth_steps(Plane& depth, const DepthLadder& ladder, int width, const Lens& lens,
                        int lens_width);

}  // namespace defray
