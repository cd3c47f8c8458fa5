// How much of what lies behind its matches explain.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "chain/patterns.h"

namespace defray {
namespace {

using Sums = std::vector<std::uint64_t>;

constexpr int columns_at_once = 16;

/// Sums with weights n - |j| along lines of `count` words, `step` apart; as many lines beside each
/// other as `lines` says.
template <int lines>
void sum_lines(const std::uint64_t* in, std::uint64_t* out, int count, std::size_t step, int n) {
  constexpr std::array<std::uint64_t, lines> none{};
  const auto at = [&](int i) { return i < 0 || i >= count ? none.data() : &in[size(i) * step]; };
  // From where all is zero: sum(x + 1) = sum(x) + values x + 1 ... x + n - values x - n + 1 ... x.
  std::array<std::uint64_t, lines> sum{}, before{}, after{};
  for (int x = -n - 1; x < count; ++x) {
    const std::uint64_t *next = at(x + 1), *joins = at(x + 1 + n), *leaves = at(x + 1 - n);
    for (std::size_t k = 0; k < lines; ++k) {
      if (x >= 0) out[size(x) * step + k] = sum[k];
      sum[k] += after[k] - before[k];
      after[k] += joins[k] - next[k];
      before[k] += next[k] - leaves[k];
    }
  }
}

/// The same in both directions. `plane` is replaced by its sums.
void sum_windows(int width, int height, int n, Sums& plane) {
  Sums rows(plane.size());
  parallel_for(height, [&](int y) {
    const std::size_t first = size(y) * size(width);
    sum_lines<1>(&plane[first], &rows[first], width, 1, n);
  });
  parallel_for((width + columns_at_once - 1) / columns_at_once, [&](int i) {
    const int first = i * columns_at_once;
    if (first + columns_at_once <= width) {
      sum_lines<columns_at_once>(&rows[size(first)], &plane[size(first)], height, size(width), n);
      return;
    }
    for (int x = first; x < width; ++x) {
      sum_lines<1>(&rows[size(x)], &plane[size(x)], height, size(width), n);
    }
  });
}

std::uint64_t squared(std::uint64_t v) { return v * v; }

/// One plane of sums over the known pixels' words.
template <typename Word>
Sums sums_of(const Frame& frame, const Words& pixels, int n, const Word& word) {
  Sums plane(pixels.size());
  const auto words = pixels.host();
  parallel_for_each(words.size(), [&](std::size_t i) {
    const std::uint64_t v = words[i];
    if (v & DEFRAY_PATTERN_KNOWN) plane[i] = word(v & 255, v >> 8 & 255, v >> 16 & 255);
  });
  sum_windows(frame.width, frame.height, n, plane);
  return plane;
}

}  // namespace

Plane pattern_variance(const Frame& frame, const Words& pixels, const PatternSettings& settings) {
  // Two sums in a word, as in params.h; those of colours are below 255 x 2^22.4 < 2^32.
  constexpr std::uint64_t one = std::uint64_t{1} << DEFRAY_PATTERN_COUNT_BIT;
  const int n = settings.window_px;
  const Sums squares =
      sums_of(frame, pixels, n, [](std::uint64_t r, std::uint64_t g, std::uint64_t b) {
        return one + squared(r) + squared(g) + squared(b);
      });
  const Sums red_green =
      sums_of(frame, pixels, n,
              [](std::uint64_t r, std::uint64_t g, std::uint64_t) { return r | g << 32; });
  const Sums blue =
      sums_of(frame, pixels, n, [](std::uint64_t, std::uint64_t, std::uint64_t b) { return b; });
  Plane variance(pixels.size());
  const auto words = pixels.host();
  parallel_for_each(variance.size(), [&](std::size_t i) {
    const std::uint64_t count = squares[i] >> DEFRAY_PATTERN_COUNT_BIT;
    if (!(words[i] & DEFRAY_PATTERN_BEHIND) || count == 0) return;
    // n sum(v^2) - sum(v)^2, below 2^62.4: exact, and never negative.
    const std::uint64_t scaled = count * (squares[i] & (one - 1)) -
                                 squared(red_green[i] & 0xffffffffu) - squared(red_green[i] >> 32) -
                                 squared(blue[i]);
    const auto known = static_cast<double>(count);
    variance[i] = static_cast<float>(static_cast<double>(scaled) / (known * known));
  });
  return variance;
}

void blend_patterns(const Words& pixels, const PatternSums& sums, const Plane& variance,
                    Planes& behind) {
  const auto words = pixels.host();
  std::vector<std::span<float>> colour;
  for (Values<float>& channel : behind) colour.push_back(channel.edit());
  parallel_for_each(variance.size(), [&](std::size_t i) {
    const float weight = sums.weight[i];
    if (!(words[i] & DEFRAY_PATTERN_BEHIND) || !(weight > 0) || !(variance[i] > 0)) return;
    const float gain = 1 - sums.weighted_square[i] / weight / (2 * variance[i]);
    if (!(gain > 0)) return;
    for (std::size_t c = 0; c < colour.size(); ++c) {
      const float moved = colour[c][i] + gain * (sums.difference[c][i] / weight);
      if (std::isfinite(moved)) colour[c][i] = moved;
    }
  });
}

}  // namespace defray
