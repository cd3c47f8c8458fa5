// Kernel `highlights_add`.
#include "device/ray_buffers.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow highlights_add_launch({.kernel = "highlights_add", .group = {1, 1}});

}  // namespace

void RayBuffers::add_light(const DefrayRdbParams& p, const RayWindow& window) {
  if (!lights_) return;
  const DefrayLightParams l{word(lights_->tiles_x), lights_->share_of_light, lights_->spread};
  const Lanes lanes(session_);
  const std::size_t rows = lanes.over_rows(p.band_y % lanes.down + p.band_rows);
  session_.launch("highlights_add", {lanes.over_columns(p.width), rows}, p, l, light_first, list_,
                  where_, excess_, table_, cell_map_, winner, window.coc, window.coverage, rim_x,
                  rim_y, means);
}

}  // namespace defray
