// Kernel `soften`.
#include "device/device_backend.h"
#include "lens/coc.h"
#include "lens/lens_grid.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow soften_launch({.kernel = "soften",
                               .group = {2, 1},
                               .reach_px = 1,
                               .bytes_a_surface = 2 * Launch::plane + 2 * Launch::colour,
                               .run_px = DEFRAY_RUN});

}  // namespace

Planes DeviceBackend::soften(const Frame& f, int lens_points, Planes into) {
  const Words whole(f.coverage.empty() ? f.surfaces() : 0, DEFRAY_WHOLE);
  const Words& coverage = f.coverage.empty() ? whole : f.coverage;
  const float cells = cells_per_side(lens_points);
  const auto reach = static_cast<std::int64_t>(static_cast<float>(f.coc_range().largest_radius()) *
                                               px_per_quantum / cells);
  Planes out = std::move(into);
  for_each_band(session_, "soften", f, reach, [&](Band& band) {
    const DefraySoftenParams p{word(f.width), word(band.rows().window_rows), word(f.layers), cells};
    const auto made = band.out(out, f.channels.size());
    band.launch(p, band.in(f.coc_quanta), band.in(coverage), band.in(f.channels), made);
  });
  return out;
}

}  // namespace defray
