#include "frame/band_rows.h"

#include <algorithm>

#include "base/plane.h"

namespace defray {

int rows_that_fit(int height, std::size_t memory_bytes, std::size_t fixed_bytes,
                  std::size_t row_bytes, int step) {
  const std::size_t left = memory_bytes - std::min(fixed_bytes, memory_bytes);
  const std::size_t rows = left / std::max<std::size_t>(1, row_bytes);
  const int most = static_cast<int>(std::min(rows, size(height + step - 1)));
  return std::max(most / step, 1) * step;
}

std::vector<BandRows> cut_into_bands(int height, int rows, std::int64_t reach, int step) {
  std::vector<BandRows> bands;
  for (std::int64_t y = 0; y < height; y += rows) {
    const std::int64_t end = std::min<std::int64_t>(height, y + rows);
    const std::int64_t window_y = std::max<std::int64_t>(0, y - reach) / step * step;
    const std::int64_t window_end = std::min<std::int64_t>(height, end + reach);
    bands.push_back({static_cast<int>(y), static_cast<int>(end - y), static_cast<int>(window_y),
                     static_cast<int>(window_end - window_y)});
  }
  return bands;
}

std::vector<BandRows> cut_into_windows(int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes) {
  // Windows begin up to a step earlier than they need to.
  const int around = 2 * static_cast<int>(std::min<std::int64_t>(reach, height)) + step;
  const int rows = rows_that_fit(height, memory_bytes, size(around) * row_bytes, row_bytes, step);
  return cut_into_bands(height, rows, reach, step);
}

}  // namespace defray
