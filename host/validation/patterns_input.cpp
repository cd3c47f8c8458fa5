#include "validation/patterns_input.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace defray::validation {

namespace {

/// Every second of few digits: parallel shifts of exactly the shortest and longest length, and
/// halfway between pixels.
float any_inverse(Random& random) {
  const double value = random.next();
  return static_cast<float>(random.next() < 0.5 ? value : std::floor(16 * value) / 16);
}

}  // namespace

int window_of(const Case& c) { return std::array{6, 1, 2, 3}[c.seed % 4]; }

PatternCase::PatternCase(const Case& c, const Input& in, bool hides_everything)
    : frame(frame_of(c, in)), behind(frame.without_planes()) {
  std::vector<std::int32_t> coc = in.coc_quanta;
  std::reverse(coc.begin(), coc.end());
  behind.coc_quanta = std::move(coc);
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) add_pixel(Random(x, y, c.seed + 1), in, hides_everything);
  }
  frame.inverse = std::move(inverse_);
  behind.inverse = std::move(behind_inverse_);
  for (const Plane& plane : in.channels) {
    behind.channels.emplace_back(Plane(plane.rbegin(), plane.rend()));
  }
  settings.window_cells = window_of(c);
  // Some pairs are of one surface, some are not.
  settings.tolerance_quanta = 256 + static_cast<std::int32_t>(128 * c.coc_px);
  add_shifts(c);
  pixels = patterns_pixels(std::move(encoded_), frame.channels, behind_);
}

void PatternCase::add_pixel(Random random, const Input& in, bool hides_everything) {
  const std::size_t i = encoded_.size();
  std::uint32_t word = random.next() < 0.8 ? DEFRAY_PATTERN_KNOWN : 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float v = in.channels[std::min(k, in.channels.size() - 1)][i];
    word |= static_cast<std::uint32_t>(v > 0 ? 255 * std::min(v, 1.0f) : 0.0f) << (8 * k);
  }
  encoded_.push_back(word);
  inverse_.push_back(any_inverse(random));
  behind_inverse_.push_back(any_inverse(random));
  behind_.push_back(hides_everything || random.next() < 0.1);
}

/// Some lead out of the frame altogether.
void PatternCase::add_shifts(const Case& c) {
  Random random(1, 2, c.seed);
  const auto any = [&](int extent) {
    const int most = std::min(extent, 40);
    return static_cast<int>(std::floor((2 * most + 1) * random.next())) - most;
  };
  for (int i = 0; i < shift_count; ++i) {
    const int x = any(c.width);
    const int y = any(c.height);
    shifts.push_back({x, y, 0, static_cast<float>(std::floor(4000 * random.next()))});
  }
  // The first is what kernels by themselves are checked with.
  PatternShift& parallel = shifts[c.seed % 2];
  parallel.parallel = static_cast<float>(std::floor(80 * random.next()));
  (c.seed % 3 == 0 ? parallel.x : parallel.y) = 0;
}

}  // namespace defray::validation
