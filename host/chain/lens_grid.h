#pragma once
// How dense lens points are.
#include <cmath>
#include <numbers>

namespace defray {

/// Cells a side of a square grid as dense as `lens_points` in a disc: sqrt(4 n / pi).
inline float cells_a_side(int lens_points) {
  return static_cast<float>(std::sqrt(lens_points * 4 / std::numbers::pi));
}

}  // namespace defray
