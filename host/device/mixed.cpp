// Kernels `repair` and `mixed`.
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
// A ramp's ends are looked for two pixels away, and what is flat one further.
const LaunchRow repair_launch({.kernel = "repair",
                               .group = {8, 1},
                               .reach_px = 3,
                               .bytes_a_surface = 2 * Launch::plane,
                               .run_px = DEFRAY_RUN});

DefrayFrameParams window_of(const Frame& f, const Band& band) {
  return {word(f.width), word(band.rows().window_rows)};
}

/// A kernel of one input and one output plane.
Words words_of(Session& session, const char* kernel, const Frame& f, Words out,
               const std::function<void(const Band&, Words&)>& after = {}) {
  for_each_band(session, kernel, f, 0, [&](Band& band) {
    const cl::Buffer made = band.out(out);
    band.launch(window_of(f, band), band.in(f.coc_quanta), made);
    if (after) after(band, out);
  });
  return out;
}

}  // namespace

Words DeviceBackend::repair(const Frame& f, Words into) {
  // The kernel counts from the window's first pixel.
  return words_of(session_, "repair", f, std::move(into), [&](const Band& band, Words& source) {
    if (band.first() == 0) return;
    const std::size_t first = size(band.rows().y) * size(f.width);
    for (std::uint32_t& i : source.edit().subspan(first, size(band.rows().rows) * size(f.width))) {
      i += static_cast<std::uint32_t>(band.first());
    }
  });
}

Words DeviceBackend::mixed(const Frame& f, Words into) {
  return words_of(session_, "mixed", f, std::move(into));
}

}  // namespace defray
