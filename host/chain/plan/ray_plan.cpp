#include "chain/plan/ray_plan.h"

#include "lens/aperture.h"
#include "lens/cats_eye.h"
#include "lens/landing_radii.h"
#include "lens/lens_grid.h"
#include "lens/lens_points.h"
#include "rdb/sparse_tiles.h"

namespace defray {

RayPlan ray_plan(const ChainSettings& settings, bool wants_nearest) {
  validate(settings.aperture);
  RayPlan plan;
  plan.lens = make_lens_points(settings.aperture, round_cells(settings.cells_per_side));
  plan.lens.landing_radii = landing_radii(plan.lens);
  plan.has_spans = true;
  plan.wants_nearest = wants_nearest;
  plan.by = settings.rays;
  if (settings.sparse) plan.sparse_from = sparse_from_quanta;
  return plan;
}

void place_rays(const Frame& f, double cats_eye, RayPlan& plan) {
  plan.origin_x = f.origin_x;
  plan.origin_y = f.origin_y;
  if (cats_eye == 0) return;
  const int width = f.display_width > 0 ? f.display_width : f.width - 2 * f.margin;
  const int height = f.display_height > 0 ? f.display_height : f.height - 2 * f.margin;
  const auto rim = [&](int x, int y) {
    return rim_centre(cats_eye, f.origin_x + x + 0.5, f.origin_y + y + 0.5, width, height);
  };
  for (int x = 0; x < f.width; ++x) plan.rim_x.push_back(rim(x, 0)[0]);
  for (int y = 0; y < f.height; ++y) plan.rim_y.push_back(rim(0, y)[1]);
}

}  // namespace defray
