#pragma once
// The circle of confusion of every pixel, and what methods need to know of it.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "lens/lens.h"
#include "opencl/session.h"

namespace defray {

/// Pixels in a quantum of the CoC radius.
inline constexpr float px_per_quantum = 1.0f / (1 << DEFRAY_COC_FRACTION_BITS);

/// A CoC, limited so that differences stay in range: what is beyond has left every frame.
inline std::int32_t tame(std::int32_t quanta) {
  return std::clamp(quanta, -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA);
}

/// Signed CoC radius of every pixel, in quanta (1/256 px). `depth` is planar, > 0, +inf:
/// background.
std::vector<std::int32_t> coc_on_device(Session& session, const Lens& lens, int display_width_px,
                                        const Plane& depth);

/// The largest |CoC radius|, quanta; 0 for an empty plane.
std::int32_t largest_coc(const std::vector<std::int32_t>& coc_quanta);

}  // namespace defray
