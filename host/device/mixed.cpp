// Kernel `mixed`.
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// Whether a step to the next pixel goes on is looked at one further.
const LaunchRow mixed_launch({.kernel = "mixed",
                              .group = {8, 1},
                              .reach_px = 2,
                              .bytes_a_surface = 2 * Launch::plane,
                              .run_px = DEFRAY_RUN});

}  // namespace

Words DeviceBackend::mixed(const Frame& f, Words into) {
  for_each_band(session_, "mixed", f, 0, [&](Band& band) {
    const cl::Buffer made = band.out(into);
    band.launch(DefrayFrameParams{word(f.width), word(band.rows().window_rows)},
                band.in(f.coc_quanta), made);
  });
  return into;
}

}  // namespace defray
