#pragma once
// What a result shows that its truth does not: edges, and changes from frame to frame. Pictures are
// linear R G B planes; any more planes are ignored.
#include <vector>

#include "base/plane.h"

namespace defray {

/// How far something rises above what the truth has within 2 px (a square of 5 px), over all
/// pixels, 0 where it does not: in 255ths of the sRGB-encoded, clipped luma (Rec. 709 weights).
/// What the truth has too, or has more of, costs nothing. NaN where a value was NaN.
struct Excess {
  double rms = 0;
  double p999 = 0;  ///< 99.9th percentile: of 1000 pixels one is worse.
  double worst = 0;
  int worst_x = 0, worst_y = 0;
};

/// Of gradients: lengths of central differences, one-sided at the frame's edges.
/// Throws Error(usage) when sizes differ or R G B lack.
Excess false_edges(const std::vector<Plane>& result, const std::vector<Plane>& truth, int width);

/// Of absolute changes from one frame to the next: what flickers, pops or swims and should not.
/// Throws Error(usage) when sizes differ or R G B lack.
Excess false_changes(const std::vector<Plane>& result, const std::vector<Plane>& next_result,
                     const std::vector<Plane>& truth, const std::vector<Plane>& next_truth,
                     int width);

}  // namespace defray
