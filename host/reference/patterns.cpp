// Twins of kernels/chain/patterns.cl and patterns_match.cl, pixel by pixel and window by window.
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/parallel.h"
#include "chain/patterns/patterns_cells.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

constexpr std::uint32_t count_bit = 24;  // that of DEFRAY_PATTERN_KNOWN
constexpr int left_cells = DEFRAY_PATTERN_MARGIN * DEFRAY_PATTERN_UNIT;  // before the frame's first

class Grid {
 public:
  explicit Grid(const Frame& frame) : frame_(frame) {}
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < frame_.width && y < frame_.height; }
  std::size_t at(int x, int y) const { return size(y) * size(frame_.width) + size(x); }

  /// The match of (x, y), where 1/depth is so much: none outside the frame, nor of a parallel shift
  /// that is too short or too long there.
  std::optional<std::size_t> match(int x, int y, const PatternShift& s, float inverse) const {
    int dx = s.x, dy = s.y;
    if (s.parallel != 0) {
      const int most = std::max(std::abs(s.x), std::abs(s.y));
      const int length = parallel_length(s.parallel, inverse, most);
      if (length == 0) return {};
      dx = std::clamp(s.x, -length, length);
      dy = std::clamp(s.y, -length, length);
    }
    if (!has(x + dx, y + dy)) return {};
    return at(x + dx, y + dy);
  }

 private:
  const Frame& frame_;
};

bool close(std::int32_t a, std::int32_t b, std::int32_t tolerance) {
  return std::abs(std::int64_t{a} - b) <= tolerance;
}

std::uint32_t squared_difference(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (const int bit : {0, 8, 16}) {
    const int d = static_cast<int>(a >> bit & 255) - static_cast<int>(b >> bit & 255);
    sum += d * d;
  }
  return static_cast<std::uint32_t>(sum);
}

/// One shift around one cell: the squared difference, and its weight.
struct Weight {
  Weight(std::uint32_t squares, std::uint32_t pairs, float frame_square, float frame_pairs) {
    const float mean = (static_cast<float>(squares) + frame_pairs * frame_square) /
                           (static_cast<float>(pairs) + frame_pairs) +
                       0.65025f;
    const float ratio = 650.25f / mean, square = ratio * ratio;
    w = square * square * square;
    square_w = w * mean;
  }
  float w, square_w;
};

/// Sums over shifts, a pixel.
struct Sums {
  Sums(std::size_t channels, std::size_t pixels)
      : difference(channels, Plane(pixels)), weight(pixels), square(pixels) {}
  std::vector<Plane> difference;
  Plane weight, square;
};

/// Cells of one shift.
class CellPlane {
 public:
  CellPlane(const Frame& frame, const std::vector<std::uint32_t>& cells, float frame_square, int n)
      : row_words_(static_cast<int>(pattern_row_words(frame.width))),
        rows_(pattern_rows(frame.height)),
        cells_(cells),
        frame_square_(frame_square),
        n_(n) {}

  /// The window around a pixel's cell; none without a pair.
  std::optional<Weight> weight(int x, int y) const {
    std::uint32_t squares = 0, pairs = 0;
    for (int j = 1 - n_; j < n_; ++j) {
      for (int i = 1 - n_; i < n_; ++i) {
        const int column = x / DEFRAY_PATTERN_CELL + i, row = y / DEFRAY_PATTERN_CELL + j;
        if (row < 0 || row >= rows_) continue;
        const std::uint32_t cell = cells_[size(row * row_words_ + column + left_cells)];
        const auto times = static_cast<std::uint32_t>((n_ - std::abs(i)) * (n_ - std::abs(j)));
        squares += times * (cell % (1u << count_bit));
        pairs += times * (cell >> count_bit);
      }
    }
    if (pairs == 0) return {};
    return Weight(squares, pairs, frame_square_, frame_pairs(n_));
  }

 private:
  int row_words_, rows_;
  const std::vector<std::uint32_t>& cells_;
  float frame_square_;
  int n_;
};

void add_shift(const Frame& frame, const Frame& behind, const Words& pixels, PatternShift shift,
               const PatternSettings& settings, Sums& out) {
  const Grid f(frame);
  const std::vector<std::uint32_t> cells = patterns_difference(frame, pixels, {shift}, settings);
  const CellPlane plane(frame, cells, shift.frame_square, settings.window_cells);
  parallel_for(frame.height, [&](int y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t here = f.at(x, y);
      if (!(pixels[here] & DEFRAY_PATTERN_BEHIND)) continue;
      const auto there = f.match(x, y, shift, behind.inverse[here]);
      if (!there || !(pixels[*there] & DEFRAY_PATTERN_KNOWN)) continue;
      const std::int32_t own = behind.coc_quanta[here];
      if (!close(frame.coc_quanta[*there], own, settings.tolerance_quanta)) continue;
      const auto weight = plane.weight(x, y);
      if (!weight) continue;
      for (std::size_t c = 0; c < out.difference.size(); ++c) {
        const float moved = frame.channels[c][*there] - behind.channels[c][here];
        out.difference[c][here] += weight->w * moved;
      }
      out.weight[here] += weight->w;
      out.square[here] += weight->square_w;
    }
  });
}

}  // namespace

std::vector<std::uint32_t> patterns_difference(const Frame& frame, const Words& pixels,
                                               const std::vector<PatternShift>& shifts,
                                               const PatternSettings& settings) {
  const Grid f(frame);
  const std::size_t row = pattern_row_words(frame.width), units = size(pattern_units(frame.width));
  const std::size_t count = row * size(pattern_rows(frame.height));
  const Words needed = needed_units(frame, pixels, settings.window_cells);
  std::vector<std::uint32_t> cells(shifts.size() * count);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int x = static_cast<int>(i % size(frame.width)),
              y = static_cast<int>(i / size(frame.width));
    const std::size_t cell_y = size(y / DEFRAY_PATTERN_CELL);
    const bool is_needed = needed[cell_y * units + size(x / DEFRAY_RUN)] != 0;
    if (!is_needed || !(pixels[i] & DEFRAY_PATTERN_KNOWN)) continue;
    const std::size_t cell = cell_y * row + size(left_cells + x / DEFRAY_PATTERN_CELL);
    for (std::size_t s = 0; s < shifts.size(); ++s) {
      const auto there = f.match(x, y, shifts[s], frame.inverse[i]);
      if (!there || !(pixels[*there] & DEFRAY_PATTERN_KNOWN)) continue;
      const std::int32_t own = frame.coc_quanta[i];
      if (!close(own, frame.coc_quanta[*there], settings.tolerance_quanta)) continue;
      cells[s * count + cell] += (1u << count_bit) + squared_difference(pixels[i], pixels[*there]);
    }
  }
  return cells;
}

Frame TwinBackend::patterns(const Frame& frame, Frame behind, const Words& pixels,
                            const Values<float>& variance, const std::vector<PatternShift>& shifts,
                            const PatternSettings& settings) {
  Sums sums(frame.channels.size(), pixels.size());
  for (const PatternShift& shift : shifts) add_shift(frame, behind, pixels, shift, settings, sums);
  std::vector<std::span<float>> colour;
  for (Values<float>& channel : behind.channels) colour.push_back(channel.edit());
  const int columns = pattern_units(frame.width) * DEFRAY_PATTERN_UNIT;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t x = i % size(frame.width), y = i / size(frame.width);
    const float v = variance[y / DEFRAY_PATTERN_CELL * size(columns) + x / DEFRAY_PATTERN_CELL];
    const float w = sums.weight[i];
    if (!(pixels[i] & DEFRAY_PATTERN_BEHIND) || !(w > 0) || !(v > 0)) continue;
    const float gain = 1 - sums.square[i] / w / (2 * v);
    if (!(gain > 0)) continue;
    for (std::size_t c = 0; c < colour.size(); ++c) {
      const float moved = colour[c][i] + gain * (sums.difference[c][i] / w);
      if (std::isfinite(moved)) colour[c][i] = moved;
    }
  }
  return behind;
}

}  // namespace defray::reference
