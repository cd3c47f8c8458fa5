#include "chain/patterns/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/parallel.h"
#include "base/srgb.h"

namespace defray {

float frame_pairs(int window_cells) {
  const float n2 = static_cast<float>(window_cells * window_cells);
  // PSNR by shares of 0.5 to 20 % (built-in scenes, 640x400): plate1, whose texture has no
  // period, 41.19, 41.38 (1 %), 41.43 (1.5 %), 41.48 dB; plate2, whose checkers have, falls from
  // 0.02 dB at 1.5 % to 0.3. 10 % of a window's pairs as the least, and no mean: plate1 41.05,
  // floors behind balls 0.2 dB less.
  return 0.015f * n2 * n2 * (DEFRAY_PATTERN_CELL * DEFRAY_PATTERN_CELL);
}

namespace {

/// Flags of a word of 8-bit colour and DEFRAY_PATTERN_KNOWN.
class PatternFlags {
 public:
  explicit PatternFlags(const Planes& channels) {
    for (const Values<float>& channel : channels) colour_.push_back(channel.host());
  }

  std::uint32_t flagged(std::uint32_t word, std::size_t pixel, bool is_behind) const {
    for (const auto& channel : colour_) {
      const bool is_plain = std::fabs(channel[pixel]) <= 1.0f;  // no NaN is
      if (!is_plain) word &= ~DEFRAY_PATTERN_KNOWN;
    }
    return is_behind ? word | DEFRAY_PATTERN_BEHIND : word;
  }

 private:
  std::vector<std::span<const float>> colour_;
};

bool is_any_behind(const Frame& f, const Words& pixels) {
  const auto words = pixels.host().subspan(f.index(0, f.wanted_rows().y),
                                           size(f.wanted_rows().count()) * size(f.width));
  return parallel_any(words.size(),
                      [&](std::size_t i) { return (words[i] & DEFRAY_PATTERN_BEHIND) != 0; });
}

}  // namespace

Words patterns_pixels(const Frame& f, const Frame& behind, const Words& mixed, Words into) {
  if (into.empty()) into = Words::room(f.pixels());
  const auto words = into.edit();
  const auto is_mixed = mixed.host();
  const auto inverse = behind.inverse.host();
  std::array<std::span<const float>, 3> rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = f.channels[std::min(c, f.channels.size() - 1)].host();
  }
  const PatternFlags flags(f.channels);
  const Rows wanted = f.wanted_rows();
  parallel_for(wanted.count(), [&](int row) {
    const int y = wanted.y + row;
    for (int x = 0; x < f.width; ++x) {
      const std::size_t i = f.index(x, y);
      const bool hides = is_mixed[i] || inverse[i] >= 0 || f.is_in_margin(x, y);
      const std::uint32_t known = hides ? 0 : DEFRAY_PATTERN_KNOWN;
      const std::uint32_t word = known | shown_8_bit(rgb[0][i]) | shown_8_bit(rgb[1][i]) << 8 |
                                 shown_8_bit(rgb[2][i]) << 16;
      words[i] = flags.flagged(word, i, inverse[i] >= 0);
    }
  });
  return into;
}

Words patterns_pixels(std::vector<std::uint32_t> encoded, const Planes& channels,
                      const std::vector<bool>& is_behind) {
  const PatternFlags flags(channels);
  parallel_for_each(encoded.size(), [&](std::size_t i) {
    encoded[i] = flags.flagged(encoded[i], i, is_behind[i]);
  });
  return encoded;
}

std::vector<PatternShift> find_shifts(Backend& backend, const Frame& frame, const Words& pixels,
                                      const PatternSettings& settings) {
  if (!is_any_behind(frame, pixels)) return {};
  std::vector<PatternShift> shifts = find_pattern_shifts(backend, frame, pixels, settings);
  const std::vector<PatternShift> parallel = find_parallel_shifts(frame, pixels, settings);
  shifts.insert(shifts.end(), parallel.begin(), parallel.end());
  return shifts;
}

int pattern_rows_around(const PatternSettings& settings) {
  constexpr int refined_px = 3;  // beyond what was asked for
  return std::max(settings.reach_y_px + refined_px, settings.parallel_reach_y_px) +
         (settings.window_cells + 1) * DEFRAY_PATTERN_CELL;
}

void improve_by_patterns(Backend& backend, const Frame& frame, const Words& pixels,
                         const std::vector<PatternShift>& shifts, const PatternSettings& settings,
                         Frame& behind) {
  if (shifts.empty() || !is_any_behind(frame, pixels)) return;
  const Values<float> variance = patterns_variance(frame, behind, pixels, settings);
  behind = backend.patterns(frame, std::move(behind), pixels, variance, shifts, settings);
}

}  // namespace defray
