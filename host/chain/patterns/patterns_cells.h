#pragma once
// The cells of pixels in which the kernels of `patterns` compare a picture with itself, and the
// units of them that a work-item takes.
#include "chain/patterns/patterns.h"

namespace defray {

/// Units in a row of a frame.
inline int pattern_units(int width) { return (width + DEFRAY_RUN - 1) / DEFRAY_RUN; }

/// Rows of cells of a frame.
inline int pattern_rows(int height) {
  return (height + DEFRAY_PATTERN_CELL - 1) / DEFRAY_PATTERN_CELL;
}

/// Words of a row of cells of `patterns_difference`, with its margins.
inline std::size_t pattern_row_words(int width) {
  return size(pattern_units(width) + 2 * DEFRAY_PATTERN_MARGIN) * DEFRAY_PATTERN_UNIT;
}

/// 1 for units that the window of a pixel with something behind it holds cells of: the others would
/// not change the wanted rows of the result. [rows of cells][units]
Words needed_units(const Frame& frame, const Words& pixels, int window_cells);

}  // namespace defray
