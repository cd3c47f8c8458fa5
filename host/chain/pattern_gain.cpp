// How much of what lies behind its matches explain.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "chain/patterns.h"

namespace defray {
namespace {

std::size_t as_size(int i) { return static_cast<std::size_t>(i); }

using Words = std::vector<std::uint64_t>;

/// Sums with weights n - |j| along a line of `count` words, `step` apart.
void sum_line(const std::uint64_t* in, std::uint64_t* out, int count, std::size_t step, int n) {
  const auto at = [&](int i) { return i < 0 || i >= count ? 0 : in[as_size(i) * step]; };
  // From where all is zero: sum(x + 1) = sum(x) + values x + 1 ... x + n - values x - n + 1 ... x.
  std::uint64_t sum = 0, before = 0, after = 0;
  for (int x = -n - 1; x < count; ++x) {
    if (x >= 0) out[as_size(x) * step] = sum;
    sum += after - before;
    after += at(x + 1 + n) - at(x + 1);
    before += at(x + 1) - at(x + 1 - n);
  }
}

/// The same in both directions. `plane` is replaced by its sums.
void sum_windows(int width, int height, int n, Words& plane) {
  Words rows(plane.size());
  parallel_for(height, [&](int y) {
    const std::size_t first = as_size(y) * as_size(width);
    sum_line(&plane[first], &rows[first], width, 1, n);
  });
  parallel_for(width, [&](int x) {
    sum_line(&rows[as_size(x)], &plane[as_size(x)], height, as_size(width), n);
  });
}

std::uint64_t squared(std::uint64_t v) { return v * v; }

/// One plane of sums over the known pixels' words.
template <typename Word>
Words sums_of(const PatternFrame& frame, const std::vector<std::uint32_t>& pixels, int n,
              const Word& word) {
  Words plane(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint64_t v = pixels[i];
    if (v & DEFRAY_PATTERN_KNOWN) plane[i] = word(v & 255, v >> 8 & 255, v >> 16 & 255);
  }
  sum_windows(frame.width, frame.height, n, plane);
  return plane;
}

}  // namespace

Plane pattern_variance(const PatternFrame& frame, const std::vector<std::uint32_t>& pixels,
                       const PatternSettings& settings) {
  // Two sums in a word, as in params.h; those of colours are below 255 x 2^22.4 < 2^32.
  constexpr std::uint64_t one = std::uint64_t{1} << DEFRAY_PATTERN_COUNT_BIT;
  const int n = settings.window_px;
  const Words squares =
      sums_of(frame, pixels, n, [](std::uint64_t r, std::uint64_t g, std::uint64_t b) {
        return one + squared(r) + squared(g) + squared(b);
      });
  const Words red_green =
      sums_of(frame, pixels, n,
              [](std::uint64_t r, std::uint64_t g, std::uint64_t) { return r | g << 32; });
  const Words blue =
      sums_of(frame, pixels, n, [](std::uint64_t, std::uint64_t, std::uint64_t b) { return b; });
  Plane variance(pixels.size());
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const std::uint64_t count = squares[i] >> DEFRAY_PATTERN_COUNT_BIT;
    if (!frame.behind[i] || count == 0) continue;
    // n sum(v^2) - sum(v)^2, below 2^62.4: exact, and never negative.
    const std::uint64_t scaled = count * (squares[i] & (one - 1)) -
                                 squared(red_green[i] & 0xffffffffu) - squared(red_green[i] >> 32) -
                                 squared(blue[i]);
    const auto known = static_cast<double>(count);
    variance[i] = static_cast<float>(static_cast<double>(scaled) / (known * known));
  }
  return variance;
}

void blend_patterns(const PatternFrame& frame, const PatternSums& sums, const Plane& variance,
                    std::vector<Plane>& behind) {
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const float weight = sums.weight[i];
    if (!frame.behind[i] || !(weight > 0) || !(variance[i] > 0)) continue;
    const float gain = 1 - sums.weighted_square[i] / weight / (2 * variance[i]);
    if (!(gain > 0)) continue;
    for (std::size_t c = 0; c < behind.size(); ++c) {
      const float moved = behind[c][i] + gain * (sums.difference[c][i] / weight);
      if (std::isfinite(moved)) behind[c][i] = moved;
    }
  }
}

}  // namespace defray
