#include "chain/patterns_window.h"

#include <algorithm>
#include <cstdlib>

namespace defray {
namespace {

constexpr int run = DEFRAY_PATTERN_RUN;

int rounded_up(int n) { return (n + run - 1) / run * run; }

std::size_t stride_for(int width, const PatternMargins& margins) {
  return static_cast<std::size_t>(rounded_up(width + 2 * margins.x));
}

/// A grid of cells over a window, each wanted or not.
class Wanted {
 public:
  Wanted(const DefrayPatternsParams& p, int cell_x, int cell_y)
      : cell_x_(cell_x),
        cell_y_(cell_y),
        across_((static_cast<int>(p.stride) + cell_x - 1) / cell_x),
        down_((static_cast<int>(p.rows + 2 * p.margin_y) + cell_y - 1) / cell_y),
        flags_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {}

  /// Every cell that has pixels of [x0, x1) x [y0, y1).
  void add(int x0, int y0, int x1, int y1) {
    for (int j = y0 / cell_y_; j <= (y1 - 1) / cell_y_; ++j) {
      for (int i = x0 / cell_x_; i <= (x1 - 1) / cell_x_; ++i) flags_[index(i, j)] = 1;
    }
  }

  std::vector<PatternUnit> units(int first_x, int first_y) const {
    std::vector<PatternUnit> all;
    for (int j = 0; j < down_; ++j) {
      for (int i = 0; i < across_; ++i) {
        if (!flags_[index(i, j)]) continue;
        all.push_back({static_cast<std::uint32_t>(first_x + i * cell_x_),
                       static_cast<std::uint32_t>(first_y + j * cell_y_)});
      }
    }
    return all;
  }

 private:
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j * across_ + i); }
  int cell_x_, cell_y_, across_, down_;
  std::vector<char> flags_;
};

}  // namespace

PatternMargins::PatternMargins(const std::vector<PatternShift>& shifts, int window_px)
    : x(0), y(0) {
  for (const PatternShift& s : shifts) {
    x = std::max(x, std::abs(s.x));
    y = std::max(y, std::abs(s.y));
  }
  // Units begin at multiples of their width: up to two runs before what they are needed for.
  x = rounded_up(x + window_px + 1 + 2 * run);
  y += window_px + 1;
}

DefrayPatternsParams patterns_band(const Frame& frame, const PatternMargins& margins,
                                   const PatternSettings& settings, int band_y, int band_rows) {
  DefrayPatternsParams p{};
  p.width = static_cast<std::uint32_t>(frame.width);
  p.rows = static_cast<std::uint32_t>(band_rows);
  p.stride = static_cast<std::uint32_t>(stride_for(frame.width, margins));
  p.margin_x = static_cast<std::uint32_t>(margins.x);
  p.margin_y = static_cast<std::uint32_t>(margins.y);
  p.source_row = static_cast<std::uint32_t>(std::min(band_y, margins.y));
  p.window_px = settings.window_px;
  p.tolerance_quanta = static_cast<std::uint32_t>(settings.tolerance_quanta);
  p.least_pairs = least_pairs(settings.window_px);
  return p;
}

PatternUnits patterns_units(const DefrayPatternsParams& p, const std::vector<std::uint32_t>& pixels,
                            int first_row, int end_row) {
  const int n = p.window_px, rows = static_cast<int>(p.rows);
  const int left = static_cast<int>(p.margin_x), top = static_cast<int>(p.margin_y);
  constexpr int strip = DEFRAY_PATTERN_STRIP;
  Wanted match(p, DEFRAY_PATTERN_CHUNK, 1), columns(p, DEFRAY_PATTERN_COLUMNS, strip);
  for (int y = first_row; y < end_row; ++y) {
    const std::size_t row = static_cast<std::size_t>(y + top) * p.stride + p.margin_x;
    for (int x = 0; x < static_cast<int>(p.width); ++x) {
      if (!(pixels[row + static_cast<std::size_t>(x)] & DEFRAY_PATTERN_BEHIND)) continue;
      match.add(x, y, x + 1, y + 1);
      columns.add(left + x - n + 1, y, left + x + n, y + 1);
    }
  }
  PatternUnits units{{}, columns.units(0, top), match.units(left, top)};
  Wanted difference(p, run, 1);
  for (const PatternUnit& u : units.columns) {
    const int x = static_cast<int>(u.x), y = static_cast<int>(u.y);
    const int end = std::min(y + strip, top + rows);
    difference.add(x, y - n + 1, x + DEFRAY_PATTERN_COLUMNS, end + n - 1);
  }
  units.difference = difference.units(0, 0);
  return units;
}

std::size_t patterns_band_bytes(int width, const PatternMargins& margins, int rows) {
  constexpr std::size_t window_pixel = 3 * 4 + 4 + 8;  // pixels, CoC, 1/depth, differences, sums
  constexpr std::size_t target_pixel =
      2 * 4 + 4 * 4 + 4 * 4 + 2 * 4;  // both, smooth, sums, weights
  constexpr std::size_t source_pixel = 4 * 4;
  const std::size_t columns = static_cast<std::size_t>(width);
  const std::size_t band = static_cast<std::size_t>(rows);
  const std::size_t window = band + 2 * static_cast<std::size_t>(margins.y);
  return window * (stride_for(width, margins) * window_pixel + columns * source_pixel) +
         band * columns * target_pixel;
}

}  // namespace defray
