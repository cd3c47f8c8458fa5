#pragma once
// Circles of confusion in whole quanta.
#include <algorithm>
#include <cstdint>
#include <span>

#include "base/plane.h"
#include "kernels/params.h"

namespace defray {

/// Quanta of the CoC radius in a pixel, and pixels in a quantum.
inline constexpr double quanta_per_px = 1 << DEFRAY_COC_FRACTION_BITS;
inline constexpr float px_per_quantum = 1.0f / (1 << DEFRAY_COC_FRACTION_BITS);

/// A CoC, limited so that differences stay in range: what is beyond has left every frame.
inline std::int32_t tame(std::int32_t quanta) {
  return std::clamp(quanta, -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA);
}

/// Radii in pixels.
Plane radii_px(std::span<const std::int32_t> coc_quanta);

/// The largest |CoC radius|, quanta; 0 for an empty plane.
std::int32_t largest_coc(std::span<const std::int32_t> coc_quanta);

}  // namespace defray
