#include "lens/depth_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/params.h"
#include "lens/depth_slopes.h"

namespace defray {
namespace {

constexpr float no_way = std::numeric_limits<float>::infinity();
/// Half of what parts surfaces: slopes of up to as much a pixel stay whole with a step on top.
constexpr double visible_px = 0.5 * DEFRAY_JUMP_QUANTA / (1 << DEFRAY_COC_FRACTION_BITS);

/// By how much the CoC changes from a step's depth to the next one's.
double step_px(const DepthLadder& ladder, std::int32_t step, const Lens& lens, int lens_width) {
  const double scale = std::isinf(lens.focus_distance_units)
                           ? infinite_focus_scale(lens, lens_width)
                           : background_coc_px(lens, lens_width) * lens.focus_distance_units;
  return scale * std::fabs(ladder.rise(step));
}

/// Each pixel's way to the next higher and the next lower step, within its terrace, in px.
class Terraces {
 public:
  Terraces(const std::vector<std::int32_t>& steps, int width)
      : steps_(steps), width_(width), height_(static_cast<int>(steps.size()) / width) {}

  /// Of all pixels, to a step up or down; infinite where the terrace has none.
  std::vector<float> distances(bool up) const {
    std::vector<float> d(steps_.size());
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
    if (steps_[i] == DepthLadder::no_step) return no_way;
    for (const auto& [u, v] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (!is_inside(x + u, y + v)) continue;
      if (steps_[at(x + u, y + v)] == steps_[i] + (up ? 1 : -1)) return 0.5f;
    }
    return no_way;
  }

  /// From the neighbours before a pixel, or after it, in the same terrace.
  void relax(std::vector<float>& d, std::size_t i, int side) const {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    constexpr float diagonal = 1.41421356f;
    const std::array<std::array<int, 2>, 4> before{{{side, 0}, {0, side}, {1, side}, {-1, side}}};
    for (std::size_t n = 0; n < before.size(); ++n) {
      const int u = x + before[n][0], v = y + before[n][1];
      if (!is_inside(u, v) || steps_[at(u, v)] != steps_[i]) continue;
      d[i] = std::min(d[i], d[at(u, v)] + (n < 2 ? 1 : diagonal));
    }
  }

  const std::vector<std::int32_t>& steps_;
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

DepthSteps smooth_steps(Plane& depth, const DepthLadder& ladder, int width, const Lens& lens,
                        int lens_width) {
  DepthSteps report;
  const auto add = [&](std::int32_t step) {
    report.largest_px = std::max(report.largest_px, step_px(ladder, step, lens, lens_width));
  };
  for (const std::int32_t step : ladder.steps) {
    if (step != DepthLadder::no_step) add(step);
  }
  if (report.largest_px <= visible_px) return report;
  const Plane on_slopes = smoothed_slopes(ladder, width);
  const Terraces terraces(ladder.steps, width);
  const std::vector<float> higher = terraces.distances(true), lower = terraces.distances(false);
  report.largest_px = 0;  // of what is no step at all: a level surface, whatever its depth
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::int32_t step = ladder.steps[i];
    if (step == DepthLadder::no_step) continue;
    const float before = ladder.depth(step);
    const float after =
        on_slopes[i] > 0 ? on_slopes[i] : ladder.depth(step, height_of(lower[i], higher[i]));
    if (after == before) continue;
    depth[i] = depth[i] == before ? after : depth[i] * (after / before);  // of a distance its share
    report.smoothed += 1;
    add(step);
  }
  return report;
}

}  // namespace defray
