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

Rows Rows::with(std::int64_t reach, int height) const {
  return {static_cast<int>(std::max<std::int64_t>(0, y - reach)),
          static_cast<int>(std::min<std::int64_t>(height, end + reach))};
}

std::vector<BandRows> cut_into_bands(Rows wanted, int height, int rows, std::int64_t reach,
                                     int step) {
  std::vector<BandRows> bands;
  for (int y = wanted.y; y < wanted.end; y += rows) {
    const Rows band{y,
                    static_cast<int>(std::min(std::int64_t{y} + rows, std::int64_t{wanted.end}))};
    const Rows window = band.with(reach, height);
    const int first = window.y / step * step;
    bands.push_back({band.y, band.count(), first, window.end - first});
    if (rows > wanted.end - y) break;  // the sum may be beyond an int
  }
  return bands;
}

std::vector<BandRows> cut_into_bands(int height, int rows, std::int64_t reach, int step) {
  return cut_into_bands({0, height}, height, rows, reach, step);
}

std::vector<BandRows> cut_into_windows(Rows wanted, int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes) {
  // Windows begin up to a step earlier than they need to.
  const int around = 2 * static_cast<int>(std::min<std::int64_t>(reach, height)) + step;
  const int rows =
      rows_that_fit(wanted.count(), memory_bytes, size(around) * row_bytes, row_bytes, step);
  return cut_into_bands(wanted, height, rows, reach, step);
}

std::vector<BandRows> cut_into_windows(int height, std::int64_t reach, int step,
                                       std::size_t row_bytes, std::size_t memory_bytes) {
  return cut_into_windows({0, height}, height, reach, step, row_bytes, memory_bytes);
}

}  // namespace defray
