// Kernel `rdb_merge`.
#include "device/rdb_scatter.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// Cells take the most (rdb/rdb_plan.h); what is read says whether the frame stays on the device.
// Of a band: means, what was filled and what was seen, and the nearest hit, its key and source.
const LaunchRow rdb_merge_launch({.kernel = "rdb_merge",
                                  .group = {64, 1},
                                  .reach_px = 1,
                                  .bytes_a_surface = 3 * Launch::plane + Launch::colour,
                                  .bytes_a_target = 4 * Launch::plane + Launch::colour});

}  // namespace

void RdbScatter::merge(const RdbPass& pass) {
  view_window(pass);
  const DefrayRdbParams p = params_of(pass);
  session_.launch("rdb_merge", {p.width, p.band_rows}, p, buffers_.winner, window_.coc,
                  window_.depth, window_.coverage, buffers_.lens, buffers_.rim_x, buffers_.rim_y,
                  window_.channels, buffers_.means, filled_, buffers_.seen);
  buffers_.find_nearest(p, window_);
}

}  // namespace defray
