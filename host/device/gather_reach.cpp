// Kernels `gather_tiles` and `gather_reach`.
#include <algorithm>

#include "device/device_backend.h"
#include "methods/gather.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow gather_reach_launch({.kernel = "gather_reach",
                                     .group = {16, 1},
                                     .bytes_a_surface = 2 * Launch::plane});

// A work-item's surface is a tile.
constexpr std::size_t tile_bytes = DEFRAY_GATHER_TILE * DEFRAY_GATHER_TILE * Launch::plane;
const LaunchRow gather_tiles_launch({.kernel = "gather_tiles",
                                     .group = {16, 1},
                                     .bytes_a_surface = tile_bytes + Launch::plane,
                                     .bytes_a_value = tile_bytes});

}  // namespace

Quanta DeviceBackend::gather_tiles(const Frame& f) {
  const Frame tiles = gather_tiles_of(f);
  Quanta largest;
  for_each_band(session_, "gather_tiles", tiles, 0, [&](Band& band) {
    const int y = band.rows().y * DEFRAY_GATHER_TILE;
    const int rows = std::min(band.rows().rows * DEFRAY_GATHER_TILE, f.height - y);
    Band pixels(session_, "gather_tiles", f, {y, rows, y, rows});
    const cl::Buffer made = band.out(largest);
    band.launch(tile_params(f.width, rows, 0), pixels.in(f.coc_quanta), made);
  });
  return largest;
}

Quanta DeviceBackend::gather_reach(const Frame& f) {
  const Frame tiles = gather_tiles_of(f);
  DefrayTileParams p = tile_params(f.width, f.height, f.coc_range().largest_radius());
  Quanta reach = gather_tiles(f);
  for (p.along_y = 0; p.along_y < 2; ++p.along_y) {
    Quanta farther;
    for_each_band(session_, "gather_reach", tiles, p.along_y ? p.reach_tiles : 0, [&](Band& band) {
      p.tiles_y = word(band.rows().window_rows);
      const cl::Buffer made = band.out(farther);
      band.launch(p, band.in(reach), made);
    });
    reach = std::move(farther);
  }
  return reach;
}

}  // namespace defray
