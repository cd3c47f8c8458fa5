#include "chain/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/parallel.h"
#include "base/srgb.h"

namespace defray {

std::uint32_t least_pairs(int window_cells) {
  const auto n = static_cast<std::uint32_t>(window_cells);
  return (n * n * n * n * DEFRAY_PATTERN_CELL * DEFRAY_PATTERN_CELL + 9) / 10;
}

std::vector<std::uint32_t> encoded_colours(const Frame& f, const Frame& behind,
                                           const Words& mixed) {
  std::vector<std::uint32_t> encoded(f.pixels());
  const auto is_mixed = mixed.host();
  const auto inverse = behind.inverse.host();
  std::array<std::span<const float>, 3> rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = f.channels[std::min(c, f.channels.size() - 1)].host();
  }
  parallel_for_each(encoded.size(), [&](std::size_t i) {
    const bool hides = is_mixed[i] || inverse[i] >= 0 || f.is_in_margin(i);
    const std::uint32_t known = hides ? 0 : DEFRAY_PATTERN_KNOWN;
    encoded[i] =
        known | shown_8_bit(rgb[0][i]) | shown_8_bit(rgb[1][i]) << 8 | shown_8_bit(rgb[2][i]) << 16;
  });
  return encoded;
}

Words patterns_pixels(std::vector<std::uint32_t> pixels, const Planes& channels,
                      const std::vector<bool>& is_behind) {
  std::vector<std::span<const float>> colour;
  for (const Values<float>& channel : channels) colour.push_back(channel.host());
  parallel_for_each(pixels.size(), [&](std::size_t i) {
    for (const auto& channel : colour) {
      const bool is_plain = std::fabs(channel[i]) <= 1.0f;  // no NaN is
      if (!is_plain) pixels[i] &= ~DEFRAY_PATTERN_KNOWN;
    }
    if (is_behind[i]) pixels[i] |= DEFRAY_PATTERN_BEHIND;
  });
  return pixels;
}

void improve_by_patterns(Backend& backend, const Frame& frame, const Words& pixels,
                         const PatternSettings& settings, Frame& behind) {
  const auto is_behind = [](std::uint32_t pixel) { return (pixel & DEFRAY_PATTERN_BEHIND) != 0; };
  if (std::none_of(pixels.begin(), pixels.end(), is_behind)) return;
  std::vector<PatternShift> shifts = find_pattern_shifts(frame, pixels, settings);
  const std::vector<PatternShift> parallel = find_parallel_shifts(frame, pixels, settings);
  shifts.insert(shifts.end(), parallel.begin(), parallel.end());
  if (shifts.empty()) return;
  const Plane variance = patterns_variance(frame, pixels, settings);
  behind = backend.patterns(frame, std::move(behind), pixels, variance, shifts, settings);
}

}  // namespace defray
