// Kernel `highlights`.
#include "device/device_stages.h"
#include "lens/coc.h"
#include "opencl/bands.h"

namespace defray {

Values<float> DeviceStages::highlights(const Frame& f, int light_channels) {
  // As `around` in the kernel has it: discs of three pixels at least.
  const std::int64_t reach = std::max(tame(largest_coc(f.coc_quanta.host())) / 256 + 1, 3);
  Values<float> kept;
  for_each_band(session_, "highlights", f, reach, [&](Band& band) {
    const DefrayHighlightParams p{word(f.width), word(band.rows().window_rows), word(f.layers),
                                  word(light_channels)};
    const cl::Buffer made = band.out(kept);
    band.launch(p, band.in(f.coc_quanta), band.in(f.coverage), band.in(f.channels), made);
  });
  return kept;
}

}  // namespace defray
