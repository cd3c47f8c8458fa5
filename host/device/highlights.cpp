// Kernel `highlights`.
#include "chain/tiles/highlight_tiles.h"
#include "device/device_backend.h"
#include "lens/coc.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow highlights_launch({.kernel = "highlights",
                                   .group = {8, 1},
                                   .bytes_a_surface = 3 * Launch::plane + Launch::colour,
                                   .run_px = DEFRAY_RUN});

}  // namespace

Values<float> DeviceBackend::highlights(const Frame& f, int light_channels, Values<float> into) {
  const Values<float> darkest = darkest_around(f, light_channels);
  const int tiles_x = (f.width + DEFRAY_HIGHLIGHT_TILE - 1) / DEFRAY_HIGHLIGHT_TILE;
  Values<float> kept = std::move(into);
  for_each_band(
      session_, "highlights", f, highlight_reach(f.coc_range().largest_radius()),
      [&](Band& band) {
        const BandRows& rows = band.rows();
        const DefrayHighlightParams p{word(f.width), word(rows.window_rows), word(f.layers),
                                      word(light_channels), word(tiles_x)};
        const cl::Buffer tiles = band.tiles(darkest, tiles_x, DEFRAY_HIGHLIGHT_TILE);
        const cl::Buffer made = band.out(kept);
        band.launch(p, band.in(f.coc_quanta), band.in(f.coverage), band.in(f.channels), tiles,
                    made);
        session_.finish();  // the tiles are this function's own
      },
      DEFRAY_HIGHLIGHT_TILE);
  return kept;
}

}  // namespace defray
