#pragma once
// Where frames are cut when they do not fit the memory: into bands of rows, the only way there is.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace defray {

/// Rows that stages are asked for begin at multiples of this: whole tiles of every kernel.
inline constexpr int band_step = 32;

/// Rows of a frame, from the top.
struct Rows {
  int y = 0, end = 0;

  int count() const { return end - y; }
  bool empty() const { return end <= y; }
  /// These and so many on each side, of a frame of `height`.
  Rows with(std::int64_t reach, int height) const;
};

/// Rows that are worked out together, and those that they depend on, themselves among them.
struct BandRows {
  int y, rows;
  int window_y, window_rows;
};

/// Rows of a band that takes `fixed_bytes` and `row_bytes` a row: as many as fit, a multiple of
/// `step`; `step` whatever the budget, and no more than the frame's `height` takes.
int rows_that_fit(int height, std::size_t memory_bytes, std::size_t fixed_bytes,
                  std::size_t row_bytes, int step = 1);

/// Bands of `rows` rows, a multiple of `step`, from the top, with windows of `reach` rows more on
/// each side that begin at multiples of `step` too.
std::vector<BandRows> cut_into_bands(int height, int rows, std::int64_t reach, int step = 1);

/// The same of the rows `wanted` of a frame of `height`, whose first is a multiple of `step`.
std::vector<BandRows> cut_into_bands(Rows wanted, int height, int rows, std::int64_t reach,
                                     int step = 1);

/// Bands whose windows, of `row_bytes` a row, take at most `memory_bytes`: where a kernel reads
/// what it needs, no more.
std::vector<BandRows> cut_into_windows(int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes);
std::vector<BandRows> cut_into_windows(Rows wanted, int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes);

}  // namespace defray
