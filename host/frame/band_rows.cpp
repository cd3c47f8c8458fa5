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

std::size_t RowBytes::of_band(int rows, std::int64_t around, int height) const {
  return size(Rows{0, rows}.with(around, height).count()) * window + size(rows) * own;
}

std::vector<BandRows> cut_into_windows(Rows wanted, int height, std::int64_t reach, int step,
                                       const RowBytes& row_bytes, std::size_t memory_bytes) {
  const std::int64_t around = 2 * reach + step - 1;  // windows begin at a multiple of `step`
  int rows = step;
  while (rows < wanted.count() && row_bytes.of_band(rows + step, around, height) <= memory_bytes) {
    rows += step;
  }
  return cut_into_bands(wanted, height, rows, reach, step);
}

}  // namespace defray
