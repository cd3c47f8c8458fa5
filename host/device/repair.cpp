// Kernel `repair`.
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// A ramp's ends are looked for two pixels away, and what is flat one further.
const LaunchRow repair_launch({.kernel = "repair",
                               .group = {8, 1},
                               .reach_px = 3,
                               .bytes_a_surface = 3 * Launch::plane + Launch::colour,
                               .run_px = DEFRAY_RUN});

}  // namespace

Words DeviceBackend::repair(const Frame& f, Words into) {
  for_each_band(session_, "repair", f, 0, [&](Band& band) {
    const cl::Buffer ramps = band.out(into);
    band.launch(DefrayFrameParams{word(f.width), word(band.rows().window_rows)},
                band.in(f.coc_quanta), band.in(f.depth), band.in(f.channels), ramps);
  });
  return into;
}

}  // namespace defray
