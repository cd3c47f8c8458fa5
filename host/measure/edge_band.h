#pragma once
// The pixels that the blur around depth discontinuities can reach: where post-filters go wrong.
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.h"

namespace defray {

/// 1 in the edge band, 0 outside it. Two 4-neighbours form a depth discontinuity if
/// z_far > (1 + step) z_near, background (inf) being behind everything. A pixel is in the band if
/// its centre is at most max(|CoC radius|) + 1 px, Euclidean, from the centre of either pixel of a
/// discontinuity, the maximum over its two pixels. Exact. `depth` is planar; `coc_quanta` as of
/// reference::coc. Throws Error(usage) unless step is finite and >= 0.
std::vector<std::uint8_t> edge_band(const Plane& depth, int width,
                                    std::span<const std::int32_t> coc_quanta, double step);

}  // namespace defray
