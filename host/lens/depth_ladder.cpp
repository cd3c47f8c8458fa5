#include "lens/depth_ladder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lens/depth.h"

namespace defray {
namespace {

// Half floats have 13 bits less of a float's mantissa, and exponents from -14 to 15; below are
// multiples of 2^-24.
constexpr std::uint32_t dropped_bits = 13, rebias = (127u - 15u) << 10;
constexpr std::uint32_t smallest_normal = 0x0400, beyond_halves = 0x7c00;
constexpr float smallest_half = 0x1p-24f;

float of_half(std::int32_t half) {
  const auto bits = static_cast<std::uint32_t>(half);
  return bits < smallest_normal ? static_cast<float>(half) * smallest_half
                                : std::bit_cast<float>((bits + rebias) << dropped_bits);
}

/// Its bits as a half; no_step: a float with more digits, beyond them, or below 0.
std::int32_t half_of(float value) {
  if (value < 0) return DepthLadder::no_step;
  const std::uint32_t normal = (std::bit_cast<std::uint32_t>(value) >> dropped_bits) - rebias;
  const bool is_normal = normal >= smallest_normal && normal < beyond_halves;
  const float half =
      is_normal ? static_cast<float>(normal) : std::fmin(value / smallest_half, 0x1p10f);
  const auto step = static_cast<std::int32_t>(half);
  return of_half(step) == value ? step : DepthLadder::no_step;
}

}  // namespace

bool DepthLadder::has(std::int32_t step) const {
  return step >= 0 && static_cast<std::size_t>(step) < depths.size() && std::isfinite(depth(step));
}

double DepthLadder::rise(std::int32_t step) const {
  const auto inverse = [&](std::int32_t s) { return 1 / static_cast<double>(depth(s)); };
  if (has(step + 1)) return inverse(step + 1) - inverse(step);
  return has(step - 1) ? inverse(step) - inverse(step - 1) : 0;
}

float DepthLadder::depth(std::int32_t step, float height) const {
  const float here = depth(step);
  if (height == 0) return here;
  const double share = std::fabs(static_cast<double>(height));
  const double rise_there = height < 0 && has(step - 1) ? -rise(step - 1)
                            : height < 0                ? -rise(step)
                                                        : rise(step);
  const double inverse = 1 / static_cast<double>(here) + share * rise_there;
  return inverse > 0 ? static_cast<float>(1 / inverse) : here;
}

DepthLadder ladder_of_stored(const Plane& stored, int bits, const DepthSettings& settings) {
  const float sign = settings.kind == DepthKind::negative_z && bits == 0 ? -1.0f : 1.0f;
  const auto last = static_cast<float>((1 << bits) - 1);
  DepthLadder ladder;
  std::int32_t largest = 0;
  for (const float value : stored) {
    std::int32_t step = DepthLadder::no_step;
    if (std::isfinite(value) && !is_background(static_cast<double>(value), settings)) {
      step = bits > 0 ? static_cast<std::int32_t>(std::nearbyint(value * last))
                      : half_of(sign * value);
      if (step == DepthLadder::no_step) return {};
    }
    ladder.steps.push_back(step);
    largest = std::max(largest, step);
  }
  for (std::int32_t step = 0; step <= largest + 1; ++step) {
    ladder.depths.push_back(bits > 0 ? static_cast<float>(step) / last : sign * of_half(step));
  }
  return ladder;
}

void convert(DepthLadder& ladder, DepthSettings settings) {
  if (settings.kind == DepthKind::distance) settings.kind = DepthKind::z;
  settings.background.reset();  // steps that no pixel is on, 0 among them, may be no depth
  const bool is_range =
      settings.kind == DepthKind::normalized || settings.kind == DepthKind::zbuffer;
  if (is_range && ladder.depths.back() > 1) ladder.depths.pop_back();  // beyond what means a depth
  const Window row{0, 0, static_cast<int>(ladder.depths.size()), 1};
  convert_depth(ladder.depths, settings, row, row, 0, "");
  for (std::int32_t& step : ladder.steps) {
    if (!ladder.has(step)) step = DepthLadder::no_step;
  }
}

}  // namespace defray
