// Kernel `fill`.
#include "chain/tiles/fill_tiles.h"
#include "device/device_backend.h"
#include "lens/coc.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// As far as it looks beyond what it has met, and 1 for rounding.
const LaunchRow fill_launch({.kernel = "fill",
                             .group = {8, 1},
                             .reach_px = DEFRAY_FILL_MIXED +
                                         DEFRAY_FILL_LOOKS * DEFRAY_FILL_LOOK_PX + 1,
                             .bytes_a_surface = 5 * Launch::plane + 2 * Launch::colour,
                             .run_px = DEFRAY_RUN});

}  // namespace

Frame DeviceBackend::fill(const Frame& f, const Words& marks, int directions, Frame into) {
  const Quanta farthest_met = farthest_to_fill(f, marks);
  const Values<std::uint8_t> pure_around = pure_around_runs(f, marks);
  const int cells_x = (f.width + DEFRAY_FILL_CELL - 1) / DEFRAY_FILL_CELL;
  const CocRange range = f.coc_range();
  const int tiles_x = (f.width + DEFRAY_FILL_TILE - 1) / DEFRAY_FILL_TILE;
  Frame out = into.width > 0 ? std::move(into) : f.without_planes();
  for_each_band(
      session_, "fill", f, fill_reach(tame(range.largest), tame(range.least)),
      [&](Band& band) {
        const BandRows& rows = band.rows();
        const DefrayFillParams p{word(f.width), word(rows.window_rows), word(tiles_x),
                                 word(directions)};
        const cl::Buffer tiles = band.tiles(farthest_met, tiles_x, DEFRAY_FILL_TILE);
        const cl::Buffer pure = band.tiles(pure_around, cells_x, DEFRAY_FILL_CELL);
        const cl::Buffer behind_coc = band.out(out.coc_quanta), inverse = band.out(out.inverse);
        const auto behind = band.out(out.channels, f.channels.size());
        band.launch(p, band.in(f.coc_quanta), band.in(f.inverse), band.in(marks), pure, tiles,
                    band.in(f.channels), behind_coc, inverse, behind);
        session_.finish();  // tiles and cells are this function's own
      },
      DEFRAY_FILL_TILE);
  return out;
}

}  // namespace defray
