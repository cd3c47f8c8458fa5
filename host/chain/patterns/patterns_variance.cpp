// How much the known colours around what is hidden vary, and over which distance.
#include <algorithm>
#include <array>
#include <optional>

#include "base/parallel.h"
#include "chain/patterns/agreement.h"
#include "chain/patterns/patterns_cells.h"

namespace defray {
namespace {

/// Of known pixels: how many, their squares, and each colour; with a window's weights below 2^32
/// (params.h).
using Sums = std::array<std::uint32_t, 5>;

void add(Sums& sum, const Sums& more, std::uint32_t weight) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * more[k];
}

/// How much of pixels' mean squared difference counts. Of random layers (defray-perf experiment
/// layered) 14 of 50 lost to another method at 1.5 and 2, 13 at 0.5 and 1, 15 without; built-in
/// scenes lose 0.5 dB at 0.5, 0.02 at 1, nothing from there on.
constexpr double most_of_apart = 1.25;

/// Squared differences of known pixels of one surface, so far apart along a row or a column.
constexpr std::array lags_px{2, 4, 8, 16};
struct Pairs {
  std::uint64_t squares = 0, count = 0;

  void add(const Pairs& more, std::uint64_t weight) {
    squares += weight * more.squares;
    count += weight * more.count;
  }
};
using Lags = std::array<Pairs, lags_px.size()>;

/// The index of the one in lags_px that is about as far as a cell is from the nearest known one.
std::size_t lag_at(int cells_away) {
  return cells_away == 0 ? 0 : cells_away == 1 ? 1 : cells_away < 4 ? 2 : 3;
}

/// Known pixels of a cell that are of one surface, that of the first.
struct CellSurface {
  std::int32_t coc = 0;
  Sums sums{};
  Lags lags{};
};

/// Of pixels of a third surface nothing is kept.
struct Cell {
  std::array<CellSurface, 2> surfaces;
  std::optional<std::int32_t> behind_coc;  ///< Of the first fragment that lies behind.
};

bool are_close(std::int32_t a, std::int32_t b, const PatternSettings& settings) {
  return std::abs(std::int64_t{a} - b) <= settings.tolerance_quanta;
}

/// A known pixel's surface in its cell; null for a third one.
CellSurface* surface_of(Cell& cell, std::int32_t coc, const PatternSettings& s) {
  for (CellSurface& surface : cell.surfaces) {
    if (surface.sums[0] == 0) surface.coc = coc;
    if (are_close(surface.coc, coc, s)) return &surface;
  }
  return nullptr;
}

/// Reads a frame's pixels into cells.
class Pixels {
 public:
  Pixels(const Frame& f, const Frame& behind, const Words& pixels, const PatternSettings& settings)
      : width_(size(f.width)),
        words_(pixels.host()),
        coc_(f.coc_quanta.host()),
        behind_coc_(behind.coc_quanta.host()),
        settings_(settings) {}

  std::size_t count() const { return words_.size(); }

  /// The one of index i, `right` pixels before its row's end.
  void add_to(Cell& cell, std::size_t i, std::size_t right) const {
    const std::uint32_t v = words_[i], r = v & 255, g = v >> 8 & 255, b = v >> 16 & 255;
    if (v & DEFRAY_PATTERN_BEHIND && !cell.behind_coc) cell.behind_coc = behind_coc_[i];
    if (!(v & DEFRAY_PATTERN_KNOWN)) return;
    CellSurface* const own = surface_of(cell, coc_[i], settings_);
    if (!own) return;
    add(own->sums, {1, r * r + g * g + b * b, r, g, b}, 1);
    for (std::size_t k = 0; k < lags_px.size(); ++k) {
      const std::size_t lag = size(lags_px[k]);
      if (lag < right) add_pair(own->lags[k], i, i + lag);
      if (i + lag * width_ < count()) add_pair(own->lags[k], i, i + lag * width_);
    }
  }

 private:
  void add_pair(Pairs& sum, std::size_t i, std::size_t there) const {
    const bool are_of_one =
        words_[there] & DEFRAY_PATTERN_KNOWN && are_close(coc_[i], coc_[there], settings_);
    if (are_of_one) sum.add({squared_difference(words_[i], words_[there]), 1}, 1);
  }

  std::size_t width_;
  std::span<const std::uint32_t> words_;
  std::span<const std::int32_t> coc_, behind_coc_;
  const PatternSettings& settings_;
};

struct Cells {
  int columns, first, end;  ///< Rows from `first` on, below `end`.
  std::vector<Cell> cells;

  const Cell& at(int column, int row) const {
    return cells[size(row) * size(columns) + size(column)];
  }
};

/// Those of the wanted rows, and of `around` rows of cells beside them; empty where no hidden
/// cell's window reaches.
Cells cells_of(const Frame& f, const Frame& behind, const Words& pixels, int around,
               const PatternSettings& settings) {
  const int rows = pattern_rows(f.height), wanted = f.wanted_rows().y / DEFRAY_PATTERN_CELL;
  const int wanted_end = pattern_rows(f.wanted_rows().end);
  Cells cells{pattern_units(f.width) * DEFRAY_PATTERN_UNIT,
              std::max(0, wanted - around),
              std::min(rows, wanted_end + around),
              {}};
  cells.cells.resize(size(cells.columns) * size(cells.end - cells.first));
  const Pixels all(f, behind, pixels, settings);
  const Words needed = needed_units(f, pixels, settings.window_cells);
  const auto is_needed = needed.host();
  parallel_for(cells.end - cells.first, [&](int row) {
    const int y0 = (cells.first + row) * DEFRAY_PATTERN_CELL;
    const std::size_t first_unit = size(cells.first + row) * size(pattern_units(f.width));
    Cell* const own = &cells.cells[size(row) * size(cells.columns)];
    for (int y = y0; y < std::min(y0 + DEFRAY_PATTERN_CELL, f.height); ++y) {
      for (int x = 0; x < f.width; ++x) {
        if (!is_needed[first_unit + size(x / DEFRAY_RUN)]) continue;
        all.add_to(own[x / DEFRAY_PATTERN_CELL], f.index(x, y), size(f.width - x));
      }
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

/// Calls visit(surface, weight, distance) for all that a cell's window holds of the surface that it
/// hides.
template <typename Visit>
void for_each_alike(const Cells& cells, int column, int row, const PatternSettings& settings,
                    const Visit& visit) {
  const int n = settings.window_cells, rows = cells.end - cells.first;
  const std::int32_t coc = *cells.at(column, row).behind_coc;
  for (int j = std::max(1 - n, -row); j < std::min(n, rows - row); ++j) {
    for (int i = std::max(1 - n, -column); i < std::min(n, cells.columns - column); ++i) {
      for (const CellSurface& surface : cells.at(column + i, row + j).surfaces) {
        if (surface.sums[0] == 0 || !are_close(surface.coc, coc, settings)) continue;
        visit(surface, weight(n, i) * weight(n, j), std::max(std::abs(i), std::abs(j)));
      }
    }
  }
}

/// Of the surface that a cell hides.
float variance_around(const Cells& cells, int column, int row, const PatternSettings& settings) {
  Sums sum{};
  int cells_away = settings.window_cells;
  for_each_alike(cells, column, row, settings,
                 [&](const CellSurface& surface, std::uint32_t w, int distance) {
                   add(sum, surface.sums, w);
                   cells_away = std::min(cells_away, distance);
                 });
  Pairs pairs;
  const std::size_t lag = lag_at(cells_away);
  for_each_alike(
      cells, column, row, settings,
      [&](const CellSurface& surface, std::uint32_t w, int) { pairs.add(surface.lags[lag], w); });
  if (pairs.count == 0) return variance_of(sum);
  const double apart = static_cast<double>(pairs.squares) / static_cast<double>(pairs.count);
  return std::min(variance_of(sum), static_cast<float>(most_of_apart * apart));
}

}  // namespace

Values<float> patterns_variance(const Frame& frame, const Frame& behind, const Words& pixels,
                                const PatternSettings& settings) {
  const Cells cells = cells_of(frame, behind, pixels, settings.window_cells - 1, settings);
  auto variance = Values<float>::room(size(cells.columns) * size(pattern_rows(frame.height)));
  const auto out = variance.edit();
  const int wanted = frame.wanted_rows().y / DEFRAY_PATTERN_CELL;
  parallel_for(pattern_rows(frame.wanted_rows().end) - wanted, [&](int k) {
    const int row = wanted + k - cells.first;
    for (int i = 0; i < cells.columns; ++i) {
      const bool hides = cells.at(i, row).behind_coc.has_value();
      out[size(wanted + k) * size(cells.columns) + size(i)] =
          hides ? variance_around(cells, i, row, settings) : 0.0f;
    }
  });
  return variance;
}

}  // namespace defray
