#pragma once
// Where frames are cut when they do not fit the memory: into bands of rows, the only way there is.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace defray {

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

/// Bands whose windows, of `row_bytes` a row, take at most `memory_bytes`: where a kernel reads
/// what it needs, no more.
std::vector<BandRows> cut_into_windows(int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes);

}  // namespace defray
