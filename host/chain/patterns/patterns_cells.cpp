#include "chain/patterns/patterns_cells.h"

#include <algorithm>

#include "base/parallel.h"

namespace defray {

Words needed_units(const Frame& f, const Words& pixels, int window_cells) {
  const int units = pattern_units(f.width), rows = pattern_rows(f.height);
  const auto words = pixels.host();
  const Rows wanted = f.wanted_rows();
  const int first_row = wanted.y / DEFRAY_PATTERN_CELL;
  std::vector<char> hides(size(units) * size(rows));
  parallel_for(pattern_rows(wanted.end) - first_row, [&](int row) {
    const int j = first_row + row;
    for (int y = j * DEFRAY_PATTERN_CELL; y < std::min((j + 1) * DEFRAY_PATTERN_CELL, f.height);
         ++y) {
      for (int x = 0; x < f.width; ++x) {
        if (!(words[f.index(x, y)] & DEFRAY_PATTERN_BEHIND)) continue;
        hides[size(j) * size(units) + size(x / DEFRAY_RUN)] = 1;
      }
    }
  });
  std::vector<std::uint32_t> needed(hides.size());
  const int reach = window_cells - 1;
  const int beside = (reach + DEFRAY_PATTERN_UNIT - 1) / DEFRAY_PATTERN_UNIT;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < units; ++i) {
      if (!hides[size(j) * size(units) + size(i)]) continue;
      const int first = std::max(0, i - beside), end = std::min(units, i + beside + 1);
      for (int k = std::max(0, j - reach); k < std::min(rows, j + reach + 1); ++k) {
        const auto row = needed.begin() + std::ptrdiff_t{k} * units;
        std::fill(row + first, row + end, 1u);
      }
    }
  }
  return needed;
}

}  // namespace defray
