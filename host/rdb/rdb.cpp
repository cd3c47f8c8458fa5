#include "rdb/rdb.h"

#include <algorithm>

#include "kernels/params.h"
#include "lens/cats_eye.h"
#include "lens/lens_grid.h"

namespace defray {

RayPlan plan_rays(const RdbSettings& settings) {
  RayPlan plan{make_lens_grid(settings.cells_per_side, settings.jitter), settings.seed};
  plan.by = settings.rays;
  return plan;
}

std::size_t open_cells(const RayPlan& plan, std::size_t x, std::size_t y) {
  if (plan.rim_x.empty()) return plan.lens.points.size();
  const RimCentre rim{plan.rim_x[x], plan.rim_y[y]};
  return static_cast<std::size_t>(
      std::count_if(plan.lens.points.begin(), plan.lens.points.end(),
                    [&](const auto& u) { return passes_rim(rim, u[0], u[1]); }));
}

std::vector<std::uint32_t> or_own_pixel(std::vector<std::uint32_t> nearest) {
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i] == DEFRAY_EMPTY) nearest[i] = static_cast<std::uint32_t>(i);
  }
  return nearest;
}

}  // namespace defray
