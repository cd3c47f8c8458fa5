#include "chain/patterns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace defray {

std::uint32_t least_pairs(int window_px) {
  const auto n = static_cast<std::uint32_t>(window_px);
  return (n * n * n * n + 9) / 10;
}

std::vector<std::uint32_t> pattern_pixels(const PatternFrame& frame,
                                          const std::vector<Plane>& channels) {
  std::vector<std::uint32_t> pixels = frame.encoded;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const bool is_plain = std::all_of(channels.begin(), channels.end(), [i](const Plane& plane) {
      return std::fabs(plane[i]) <= 1.0f;  // no NaN is
    });
    if (!is_plain) pixels[i] &= ~DEFRAY_PATTERN_KNOWN;
    if (frame.behind[i]) pixels[i] |= DEFRAY_PATTERN_BEHIND;
  }
  return pixels;
}

PatternShift shift_at(const PatternShift& shift, float inverse) {
  if (shift.parallel == 0) return shift;
  const float px = shift.parallel * inverse;
  const int most = std::max(std::abs(shift.x), std::abs(shift.y));
  if (!(px >= DEFRAY_PATTERN_LEAST && px <= static_cast<float>(most))) return {0, 0};
  const int length = static_cast<int>(std::rint(px));
  return {std::clamp(shift.x, -length, length), std::clamp(shift.y, -length, length)};
}

void improve_by_patterns(const PatternFrame& frame, const std::vector<Plane>& channels,
                         const PatternSettings& settings, std::vector<Plane>& behind,
                         const PatternMatcher& match) {
  const auto is_behind = [](std::uint32_t flag) { return flag != 0; };
  if (std::none_of(frame.behind.begin(), frame.behind.end(), is_behind)) return;
  const std::vector<std::uint32_t> pixels = pattern_pixels(frame, channels);
  std::vector<PatternShift> shifts = find_pattern_shifts(frame, pixels, settings);
  const std::vector<PatternShift> parallel = find_parallel_shifts(frame, pixels, settings);
  shifts.insert(shifts.end(), parallel.begin(), parallel.end());
  if (shifts.empty()) return;
  const PatternSums sums = match(pixels, shifts);
  blend_patterns(frame, sums, pattern_variance(frame, pixels, settings), behind);
}

void improve_by_patterns(Session& session, const PatternFrame& frame,
                         const std::vector<Plane>& channels, const PatternSettings& settings,
                         std::vector<Plane>& behind, const std::function<void(double)>& progress) {
  improve_by_patterns(
      frame, channels, settings, behind,
      [&](const std::vector<std::uint32_t>& pixels, const std::vector<PatternShift>& shifts) {
        return match_patterns(session, frame, pixels, channels, behind, shifts, settings, progress);
      });
}

}  // namespace defray
