// Twin of kernels/rdb/span.clh.
#include <algorithm>
#include <array>
#include <cmath>

#include "reference/reference.h"

namespace defray::reference {
namespace {

/// Whether a surface goes on across a step, in view of those before and after it.
bool goes_on(double before, double step, double after) {
  const auto is_like = [&](double other) {
    const double most = std::min(std::floor(std::fabs(step) * 3 / 4), double{DEFRAY_BEND_QUANTA});
    return std::fabs(other) <= DEFRAY_RAMP_QUANTA && std::fabs(step - other) <= most;
  };
  if (!(std::fabs(step) <= DEFRAY_RAMP_QUANTA)) return false;
  return std::fabs(step) <= DEFRAY_SMALL_STEP_QUANTA || is_like(before) || is_like(after);
}

}  // namespace

Span span_of(const Frame& f, const RayPlan& plan, std::size_t surface) {
  const std::int32_t own = f.coc_quanta[surface];
  Span span{own, own};
  if (!plan.has_spans) return span;
  const int x = static_cast<int>(surface % size(f.width));
  const int row = static_cast<int>(surface / size(f.width));
  const int y = row / f.layers, layer = row % f.layers;
  for (const auto& way : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    // Radius so many pixels on, the fragment's own there or infinite.
    const auto radius = [&](int n) {
      const int px = x + n * way[0], py = y + n * way[1];
      if (px < 0 || px >= f.width || py < 0 || py >= f.height) return HUGE_VAL;
      const std::size_t at = f.index(px, py, layer);
      return is_fragment(f.depth[at]) ? static_cast<double>(f.coc_quanta[at]) : HUGE_VAL;
    };
    const double step = radius(1) - own;
    if (!goes_on(own - radius(-1), step, radius(2) - radius(1))) continue;
    const std::int32_t half_way = own + static_cast<std::int32_t>(std::floor(step / 2));
    span = {std::min(span.least, half_way), std::max(span.largest, half_way)};
  }
  return span;
}

}  // namespace defray::reference
