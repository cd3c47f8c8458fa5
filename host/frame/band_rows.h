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

/// Bands of `rows` rows, a multiple of `step`, of the rows `wanted` of a frame of `height`, whose
/// first is a multiple of `step`; their windows have `reach` rows more on each side and begin at
/// multiples of `step` too.
std::vector<BandRows> cut_into_bands(Rows wanted, int height, int rows, std::int64_t reach,
                                     int step = 1);

/// Bytes of bands: of each row of a window, and of each of the band's own rows beside.
struct RowBytes {
  std::size_t window, own = 0;

  /// Of so many rows of a frame of `height`, with `around` rows in their window beside.
  std::size_t of_band(int rows, std::int64_t around, int height) const;
};

/// Bands that take at most `memory_bytes`: where a kernel reads what it needs, no more.
std::vector<BandRows> cut_into_windows(Rows wanted, int height, std::int64_t reach, int step,
                                       const RowBytes& row_bytes, std::size_t memory_bytes);

}  // namespace defray
