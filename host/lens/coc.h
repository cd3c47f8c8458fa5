#pragma once
// Circles of confusion in whole quanta.
#include <algorithm>
#include <cstdint>
#include <span>

#include "kernels/params.h"

namespace defray {

/// Pixels in a quantum of the CoC radius.
inline constexpr float px_per_quantum = 1.0f / (1 << DEFRAY_COC_FRACTION_BITS);

/// A CoC, limited so that differences stay in range: what is beyond has left every frame.
inline std::int32_t tame(std::int32_t quanta) {
  return std::clamp(quanta, -DEFRAY_TAME_QUANTA, DEFRAY_TAME_QUANTA);
}

/// The largest |CoC radius|, quanta; 0 for an empty plane.
std::int32_t largest_coc(std::span<const std::int32_t> coc_quanta);

}  // namespace defray
