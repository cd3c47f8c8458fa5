// Kernel `feather`.
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow feather_launch({.kernel = "feather",
                                .group = {8, 1},
                                .reach_px = DEFRAY_FEATHER_PX,
                                .bytes_a_surface = 5 * Launch::plane + 2 * Launch::colour,
                                .run_px = DEFRAY_RUN});

}  // namespace

Planes DeviceBackend::feather(const Frame& behind, const Quanta& seen, const Words& marks,
                              const Words& strips, Planes into) {
  Planes out = std::move(into);
  for_each_band(session_, "feather", behind, 0, [&](Band& band) {
    const DefrayFrameParams p{word(behind.width), word(band.rows().window_rows)};
    const auto made = band.out(out, behind.channels.size());
    band.launch(p, band.in(behind.coc_quanta), band.in(behind.inverse), band.in(seen),
                band.in(marks), band.in(strips), band.in(behind.channels), made);
  });
  return out;
}

}  // namespace defray
