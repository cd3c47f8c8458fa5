#pragma once
// Depth that was stored in steps: half floats, whole numbers of 8 or 16 bits.
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "defray/options.h"

namespace defray {

/// Which step each pixel's depth is, and the depth of each step.
struct DepthLadder {
  static constexpr std::int32_t no_step = -1;

  std::vector<std::int32_t> steps;  ///< A pixel's; no_step: background. Empty: not in steps.
  std::vector<float> depths;        ///< Rising or falling, not 0; infinite: background.

  /// Whether there is such a step, and not for background.
  bool has(std::int32_t step) const;
  float depth(std::int32_t step) const { return depths[static_cast<std::size_t>(step)]; }
  /// What 1 / depth gains from a step to the next one; at the last one as to it; 0: there is but
  /// one.
  double rise(std::int32_t step) const;
  /// `height` of a step, -0.5 to 0.5, above a step, linear in 1 / depth, as the CoC is.
  float depth(std::int32_t step, float height) const;
};

/// The steps of a plane as it is stored, with the values of those up to one above the largest: of
/// whole numbers of so many bits, scaled to 0 to 1; with 0 bits of half floats, if all are of which
/// `settings` make depths, else empty. Background is on no step.
DepthLadder ladder_of_stored(const Plane& stored, int bits, const DepthSettings& settings);

/// From stored values to depths; distances along rays stay as they are. Values must be such that
/// convert_depth takes them.
void convert(DepthLadder& ladder, DepthSettings settings);

}  // namespace defray
