#pragma once
// Linear filtering (Potmesil & Chakravarty 1981; Shinya 1994, eq. 5): every pixel spread over its
// circle of confusion, nothing occluded. A pixel's shares add up to 1: what does not leave the
// frame is conserved. Outside the frame its edge pixels repeat, colour and CoC, and send their
// light in.
#include <cstddef>
#include <cstdint>
#include <span>

namespace defray {

/// Largest CoC radius that `linear` takes: its cost grows with the square.
inline constexpr int linear_max_radius_px = 1024;

float radius_px(std::int32_t coc_quanta);

/// Reach of `linear`, in whole pixels, for these CoC radii. Throws Error(usage) above the limit.
int linear_reach(std::span<const std::int32_t> coc_quanta);

}  // namespace defray
