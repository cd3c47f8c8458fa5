// How much the known colours around what is hidden vary.
#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "chain/patterns_cells.h"

namespace defray {
namespace {

/// Of known pixels: how many, their squares, and each colour; with a window's weights below 2^32
/// (params.h).
using Sums = std::array<std::uint32_t, 5>;

void add(Sums& sum, const Sums& more, std::uint32_t weight) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * more[k];
}

struct Cells {
  int columns, first, end;  ///< Rows from `first` on, below `end`.
  std::vector<Sums> sums;
  std::vector<char> hides;  ///< Whether a cell has a fragment behind it.
};

/// Those of the wanted rows, and of `around` rows of cells beside them.
Cells cells_of(const Frame& f, const Words& pixels, int around) {
  const int rows = pattern_rows(f.height), wanted = f.wanted_rows().y / DEFRAY_PATTERN_CELL;
  const int wanted_end = pattern_rows(f.wanted_rows().end);
  Cells cells{pattern_units(f.width) * DEFRAY_PATTERN_UNIT,
              std::max(0, wanted - around),
              std::min(rows, wanted_end + around),
              {},
              {}};
  cells.sums.resize(size(cells.columns) * size(cells.end - cells.first));
  cells.hides.resize(cells.sums.size());
  const auto words = pixels.host();
  parallel_for(cells.end - cells.first, [&](int row) {
    const std::size_t pixel = size(cells.first + row) * DEFRAY_PATTERN_CELL * size(f.width);
    const std::size_t end = std::min(pixel + DEFRAY_PATTERN_CELL * size(f.width), words.size());
    for (std::size_t i = pixel; i < end; ++i) {
      const std::size_t cell = i % size(f.width) / DEFRAY_PATTERN_CELL;
      const std::size_t at = size(row) * size(cells.columns) + cell;
      const std::uint32_t v = words[i], r = v & 255, g = v >> 8 & 255, b = v >> 16 & 255;
      if (v & DEFRAY_PATTERN_KNOWN) add(cells.sums[at], {1, r * r + g * g + b * b, r, g, b}, 1);
      if (v & DEFRAY_PATTERN_BEHIND) cells.hides[at] = 1;
    }
  });
  return cells;
}

/// n sum(v^2) - sum(v)^2 over n^2; the first, below 2^47, is exact, and never negative.
float variance_of(const Sums& s) {
  const std::uint64_t count = s[0];
  if (count == 0) return 0;
  const auto squared = [](std::uint64_t v) { return v * v; };
  const std::uint64_t scaled = count * s[1] - squared(s[2]) - squared(s[3]) - squared(s[4]);
  const auto known = static_cast<double>(count);
  return static_cast<float>(static_cast<double>(scaled) / (known * known));
}

std::uint32_t weight(int n, int j) { return static_cast<std::uint32_t>(n - std::abs(j)); }

}  // namespace

Values<float> patterns_variance(const Frame& frame, const Words& pixels,
                                const PatternSettings& settings) {
  const int n = settings.window_cells;
  const Cells cells = cells_of(frame, pixels, n - 1);
  auto variance = Values<float>::room(size(cells.columns) * size(pattern_rows(frame.height)));
  const auto out = variance.edit();
  const int wanted = frame.wanted_rows().y / DEFRAY_PATTERN_CELL;
  const int rows = cells.end - cells.first;
  parallel_for(pattern_rows(frame.wanted_rows().end) - wanted, [&](int k) {
    const int row = wanted + k - cells.first;
    const std::size_t first = size(row) * size(cells.columns);
    const auto to = out.subspan(size(wanted + k) * size(cells.columns), size(cells.columns));
    std::fill(to.begin(), to.end(), 0.0f);
    const auto hides = std::span(cells.hides).subspan(first, size(cells.columns));
    if (std::find(hides.begin(), hides.end(), 1) == hides.end()) return;
    std::vector<Sums> columns(size(cells.columns));
    for (int j = std::max(1 - n, -row); j < std::min(n, rows - row); ++j) {
      const Sums* const line = &cells.sums[size(row + j) * size(cells.columns)];
      for (std::size_t i = 0; i < columns.size(); ++i) add(columns[i], line[i], weight(n, j));
    }
    for (int i = 0; i < cells.columns; ++i) {
      if (!hides[size(i)]) continue;
      Sums sum{};
      for (int j = std::max(1 - n, -i); j < std::min(n, cells.columns - i); ++j) {
        add(sum, columns[size(i + j)], weight(n, j));
      }
      to[size(i)] = variance_of(sum);
    }
  });
  return variance;
}

}  // namespace defray
