#pragma once
// How a result moves beside its truth, from one frame to the next.
#include "measure/metrics.h"

namespace defray {

/// Over all pixels, R G B alike; values sRGB-encoded and clipped to 0...1. NaN where a value was
/// NaN.
struct Flicker {
  double error_rms = 0;  ///< Of the result's change less the truth's: what moves and should not.
  double truth_rms = 0;  ///< Of the truth's change.
};

/// Two frames of a result and of its truth. Throws Error(usage) when sizes differ or R G B lack.
Flicker flicker(const std::vector<Plane>& result, const std::vector<Plane>& next_result,
                const std::vector<Plane>& truth, const std::vector<Plane>& next_truth);

}  // namespace defray
