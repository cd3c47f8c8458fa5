// Twins of kernels/patterns.cl and patterns_match.cl: sums over whole windows, nothing running
// along.
#include <cstdlib>

#include "base/parallel.h"
#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {
namespace {

class Grid {
 public:
  explicit Grid(const Frame& frame) : frame_(frame) {}
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < frame_.width && y < frame_.height; }
  std::size_t at(int x, int y) const { return size(y) * size(frame_.width) + size(x); }

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

/// Weighted sum along a line of values: value(j), 0 outside the frame.
template <typename Value>
std::uint64_t line_sum(int window_px, const Value& value) {
  std::uint64_t sum = 0;
  for (int j = 1 - window_px; j < window_px; ++j) {
    sum += static_cast<std::uint64_t>(window_px - std::abs(j)) * value(j);
  }
  return sum;
}

/// One shift at one pixel: its weight, and the squared difference times it.
struct Weight {
  explicit Weight(std::uint64_t sum) {
    const std::uint64_t count = sum >> DEFRAY_PATTERN_COUNT_BIT;
    const std::uint64_t squares = sum - (count << DEFRAY_PATTERN_COUNT_BIT);
    const float mean = static_cast<float>(squares) / static_cast<float>(count) + 0.65025f;
    const float ratio = 650.25f / mean, square = ratio * ratio;
    w = square * square * square;
    square_w = w * mean;
  }
  float w, square_w;
};

void add_shift(const Frame& frame, const Frame& behind, const Words& pixels, PatternShift shift,
               const PatternSettings& settings, PatternSums& out) {
  const Grid f(frame);
  const std::vector<std::uint64_t> columns = patterns_columns(frame, pixels, shift, settings);
  parallel_for(frame.height, [&](int y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t here = f.at(x, y);
      const PatternShift s = shift_at(shift, behind.inverse[here]);
      if (!(pixels[here] & DEFRAY_PATTERN_BEHIND) || !f.has(x + s.x, y + s.y)) continue;
      const std::size_t there = f.at(x + s.x, y + s.y);
      if (!(pixels[there] & DEFRAY_PATTERN_KNOWN)) continue;
      if (!close(frame.coc_quanta[there], behind.coc_quanta[here], settings.tolerance_quanta)) {
        continue;
      }
      const std::uint64_t sum = line_sum(
          settings.window_px, [&](int j) { return f.has(x + j, y) ? columns[f.at(x + j, y)] : 0; });
      if (sum >> DEFRAY_PATTERN_COUNT_BIT < least_pairs(settings.window_px)) continue;
      const Weight weight(sum);
      for (std::size_t c = 0; c < out.difference.size(); ++c) {
        out.difference[c][here] += weight.w * (frame.channels[c][there] - behind.channels[c][here]);
      }
      out.weight[here] += weight.w;
      out.weighted_square[here] += weight.square_w;
    }
  });
}

}  // namespace

std::vector<std::uint32_t> patterns_difference(const Frame& frame, const Words& pixels,
                                               PatternShift shift,
                                               const PatternSettings& settings) {
  const Grid f(frame);
  std::vector<std::uint32_t> out(pixels.size());
  parallel_for(frame.height, [&](int y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t here = f.at(x, y);
      const PatternShift s = shift_at(shift, frame.inverse[here]);
      const bool is_too_short = shift.parallel != 0 && s == PatternShift{0, 0};
      if (is_too_short || !f.has(x + s.x, y + s.y)) continue;
      const std::size_t there = f.at(x + s.x, y + s.y);
      const bool known =
          pixels[here] & DEFRAY_PATTERN_KNOWN && pixels[there] & DEFRAY_PATTERN_KNOWN;
      if (!known ||
          !close(frame.coc_quanta[here], frame.coc_quanta[there], settings.tolerance_quanta)) {
        continue;
      }
      out[here] = DEFRAY_PATTERN_KNOWN | squared_difference(pixels[here], pixels[there]);
    }
  });
  return out;
}

std::vector<std::uint64_t> patterns_columns(const Frame& frame, const Words& pixels,
                                            PatternShift shift, const PatternSettings& settings) {
  const Grid f(frame);
  const std::vector<std::uint32_t> difference = patterns_difference(frame, pixels, shift, settings);
  std::vector<std::uint64_t> out(pixels.size());
  parallel_for(frame.height, [&](int y) {
    for (int x = 0; x < frame.width; ++x) {
      out[f.at(x, y)] = line_sum(settings.window_px, [&](int j) -> std::uint64_t {
        if (!f.has(x, y + j)) return 0;
        const std::uint64_t d = difference[f.at(x, y + j)];
        return d ? (std::uint64_t{1} << DEFRAY_PATTERN_COUNT_BIT) + (d - DEFRAY_PATTERN_KNOWN) : 0;
      });
    }
  });
  return out;
}

PatternSums TwinBackend::patterns(const Frame& frame, const Frame& behind, const Words& pixels,
                                  const std::vector<PatternShift>& shifts,
                                  const PatternSettings& settings) {
  PatternSums out(frame.channels.size(), pixels.size());
  for (const PatternShift& shift : shifts) add_shift(frame, behind, pixels, shift, settings, out);
  return out;
}

}  // namespace defray::reference
