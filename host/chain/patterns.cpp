#include "chain/patterns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/srgb.h"

namespace defray {

std::uint32_t least_pairs(int window_px) {
  const auto n = static_cast<std::uint32_t>(window_px);
  return (n * n * n * n + 9) / 10;
}

std::vector<std::uint32_t> encoded_colours(const Frame& f, const Frame& behind,
                                           const Words& mixed) {
  std::vector<std::uint32_t> encoded(f.pixels());
  const auto is_mixed = mixed.host();
  const auto inverse = behind.inverse.host();
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    const bool hides = is_mixed[i] || inverse[i] >= 0 || f.is_in_margin(i);
    encoded[i] = hides ? 0 : DEFRAY_PATTERN_KNOWN;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = f.channels[std::min(c, f.channels.size() - 1)].host();
    for (std::size_t i = 0; i < encoded.size(); ++i) {
      encoded[i] |= shown_8_bit(channel[i]) << (8 * c);
    }
  }
  return encoded;
}

Words pattern_pixels(std::vector<std::uint32_t> pixels, const Planes& channels,
                     const std::vector<bool>& is_behind) {
  for (const Values<float>& channel : channels) {
    const auto values = channel.host();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool is_plain = std::fabs(values[i]) <= 1.0f;  // no NaN is
      if (!is_plain) pixels[i] &= ~DEFRAY_PATTERN_KNOWN;
    }
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (is_behind[i]) pixels[i] |= DEFRAY_PATTERN_BEHIND;
  }
  return pixels;
}

PatternShift shift_at(const PatternShift& shift, float inverse) {
  if (shift.parallel == 0) return shift;
  const int most = std::max(std::abs(shift.x), std::abs(shift.y));
  const int length = parallel_length(shift.parallel, inverse, most);
  return {std::clamp(shift.x, -length, length), std::clamp(shift.y, -length, length)};
}

void improve_by_patterns(Stages& stages, const Frame& frame, const Words& pixels,
                         const PatternSettings& settings, Frame& behind) {
  const auto is_behind = [](std::uint32_t pixel) { return (pixel & DEFRAY_PATTERN_BEHIND) != 0; };
  if (std::none_of(pixels.begin(), pixels.end(), is_behind)) return;
  std::vector<PatternShift> shifts = find_pattern_shifts(frame, pixels, settings);
  const std::vector<PatternShift> parallel = find_parallel_shifts(frame, pixels, settings);
  shifts.insert(shifts.end(), parallel.begin(), parallel.end());
  if (shifts.empty()) return;
  const PatternSums sums = stages.patterns(frame, behind, pixels, shifts, settings);
  blend_patterns(pixels, sums, pattern_variance(frame, pixels, settings), behind.channels);
}

}  // namespace defray
