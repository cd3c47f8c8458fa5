// Kernel `rdb_nearest`.
#include "device/ray_buffers.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow rdb_nearest_launch({.kernel = "rdb_nearest", .group = {64, 1}});

}  // namespace

void RayBuffers::find_nearest(const DefrayRdbParams& p, const RayWindow& window) {
  if (!plan_.wants_nearest) return;
  session_.launch("rdb_nearest", {p.width, p.band_rows}, p, winner, window.coc, window.data_of,
                  lens, rim_x, rim_y, nearest_);
}

}  // namespace defray
