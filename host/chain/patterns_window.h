#pragma once
// A band of a frame as the kernels of `patterns` see it, and which parts of it they need.
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "chain/patterns.h"

namespace defray {

/// The first pixel of a work-item's share, in the window.
struct PatternUnit {
  std::uint32_t x, y;
};

/// Units in which, or near which, something is hidden: the others would not change the result.
struct PatternUnits {
  std::vector<PatternUnit> difference, columns, match;
};

/// Rows and columns around a band that a window needs for these shifts.
struct PatternMargins {
  PatternMargins(const std::vector<PatternShift>& shifts, int window_px);
  int x, y;
};

/// Fields of a band; those of a launch are left 0.
DefrayPatternsParams patterns_band(const Frame& frame, const PatternMargins& margins,
                                   const PatternSettings& settings, int band_y, int band_rows);

/// A plane of the frame on the window of a band, `outside` around the frame.
template <typename T>
std::vector<T> patterns_window(const Frame& frame, const DefrayPatternsParams& p, int band_y,
                               const Values<T>& plane, T outside) {
  const std::size_t rows = p.rows + 2 * std::size_t{p.margin_y}, width = p.width;
  std::vector<T> window(rows * p.stride, outside);
  parallel_for(static_cast<int>(rows), [&](int row) {
    const std::int64_t y = std::int64_t{band_y} + row - p.margin_y;
    if (y < 0 || y >= frame.height) return;
    const auto from = plane.begin() + y * static_cast<std::int64_t>(width);
    std::copy(from, from + static_cast<std::int64_t>(width),
              window.begin() + std::int64_t{row} * p.stride + p.margin_x);
  });
  return window;
}

/// From the window of the frame's pixels: for the band's rows first_row to end_row - 1. The first
/// is a multiple of DEFRAY_PATTERN_STRIP.
PatternUnits patterns_units(const DefrayPatternsParams& p, const std::vector<std::uint32_t>& pixels,
                            int first_row, int end_row);

/// Memory for a band of so many rows.
std::size_t patterns_band_bytes(int width, const PatternMargins& margins, int rows);

}  // namespace defray
