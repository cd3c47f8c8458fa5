#pragma once
// The cells of a ray distribution buffer: sample points on the lens.
#include <array>
#include <cstdint>
#include <vector>

namespace defray {

/// n x n cells over the square around a round aperture; kept are those that a ray can pass through.
/// Lens coordinates are integers, 2^-16 of the aperture radius: kernel and twin share them exactly.
struct LensCells {
  /// (u, v) of each cell's centre, row by row.
  std::vector<std::array<std::int32_t, 2>> centres;
  /// Largest jitter offset of a cell, half a cell; 0 without jitter.
  std::int32_t jitter = 0;
};

/// Throws Error(usage) unless 1 <= cells_per_side <= 64. Without jitter a cell is kept if its
/// centre lies in the unit disc; with jitter, if any of its area does.
LensCells make_lens_cells(int cells_per_side, bool jitter);

}  // namespace defray
