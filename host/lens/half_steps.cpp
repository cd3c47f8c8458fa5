#include "lens/half_steps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/params.h"
#include "lens/half_slopes.h"

namespace defray {
namespace {

constexpr float no_step = std::numeric_limits<float>::infinity();
/// Half of what parts surfaces: slopes of up to as much a pixel stay whole with a step on top.
constexpr double visible_px = 0.5 * DEFRAY_JUMP_QUANTA / (1 << DEFRAY_COC_FRACTION_BITS);
constexpr float smallest_normal_half = 0x1p-14f;

/// A float with no more digits than a half's.
bool is_half(float z) { return (std::bit_cast<std::uint32_t>(z) & 0x1fff) == 0; }

/// By how much the CoC changes from a depth to the next half float.
double step_px(float z, const Lens& lens, int lens_width) {
  const double here = static_cast<double>(z), next = static_cast<double>(next_half(z));
  const double scale = std::isinf(lens.focus_distance_units)
                           ? infinite_focus_scale(lens, lens_width)
                           : background_coc_px(lens, lens_width) * lens.focus_distance_units;
  return scale * (1 / here - 1 / next);
}

/// Each pixel's way to the next higher and the next lower step, within its terrace, in px.
class Terraces {
 public:
  Terraces(const Plane& depth, int width)
      : depth_(depth), width_(width), height_(static_cast<int>(depth.size()) / width) {}

  /// Of all pixels, to a step up or down; infinite where the terrace has none.
  std::vector<float> distances(bool up) const {
    std::vector<float> d(depth_.size());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = distance_to(i, up);
    // A terrace that winds takes more than one turn.
    for (int turn = 0; turn < 2; ++turn) {
      for (std::size_t i = 0; i < d.size(); ++i) relax(d, i, -1);
      for (std::size_t i = d.size(); i-- > 0;) relax(d, i, 1);
    }
    return d;
  }

 private:
  bool is_inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  /// Half a pixel where a neighbour is a step higher, or lower.
  float distance_to(std::size_t i, bool up) const {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    if (!std::isfinite(depth_[i])) return no_step;
    for (const auto& [u, v] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (!is_inside(x + u, y + v)) continue;
      const float other = depth_[at(x + u, y + v)];
      if (up ? other == next_half(depth_[i]) : next_half(other) == depth_[i]) return 0.5f;
    }
    return no_step;
  }

  /// From the neighbours before a pixel, or after it, in the same terrace.
  void relax(std::vector<float>& d, std::size_t i, int side) const {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    constexpr float diagonal = 1.41421356f;
    const std::array<std::array<int, 2>, 4> before{{{side, 0}, {0, side}, {1, side}, {-1, side}}};
    for (std::size_t n = 0; n < before.size(); ++n) {
      const int u = x + before[n][0], v = y + before[n][1];
      if (!is_inside(u, v) || depth_[at(u, v)] != depth_[i]) continue;
      d[i] = std::min(d[i], d[at(u, v)] + (n < 2 ? 1 : diagonal));
    }
  }

  const Plane& depth_;
  int width_, height_;
};

/// How far above its terrace's depth a pixel is, in steps, -0.5 to 0.5. A terrace with steps on one
/// side only goes level a few pixels from them.
float height_of(float to_lower, float to_higher) {
  constexpr float level_px = 16;
  if (std::isinf(to_lower) && std::isinf(to_higher)) return 0;
  if (std::isinf(to_lower)) return 0.5f * std::max(0.0f, 1 - to_higher / level_px);
  if (std::isinf(to_higher)) return -0.5f * std::max(0.0f, 1 - to_lower / level_px);
  return to_lower / (to_lower + to_higher) - 0.5f;
}

}  // namespace

HalfSteps smooth_half_steps(Plane& depth, int width, const Lens& lens, int lens_width) {
  const bool are_halves = std::all_of(depth.begin(), depth.end(), [](float z) {
    return !std::isfinite(z) || (is_half(z) && z >= smallest_normal_half);
  });
  HalfSteps report;
  if (!are_halves) return report;
  for (const float z : depth) {
    if (std::isfinite(z))
      report.largest_px = std::max(report.largest_px, step_px(z, lens, lens_width));
  }
  if (report.largest_px <= visible_px) return report;
  const Plane before = depth, on_slopes = smoothed_slopes(before, width);
  const Terraces terraces(before, width);
  const std::vector<float> higher = terraces.distances(true), lower = terraces.distances(false);
  report.largest_px = 0;  // of what is no step at all: a level surface, whatever its depth
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (!std::isfinite(before[i])) continue;
    depth[i] = on_slopes[i] > 0 ? on_slopes[i]
                                : before[i] + height_of(lower[i], higher[i]) *
                                                  (next_half(before[i]) - before[i]);
    if (depth[i] == before[i]) continue;
    report.smoothed += 1;
    report.largest_px = std::max(report.largest_px, step_px(before[i], lens, lens_width));
  }
  return report;
}

}  // namespace defray
