// Kernel `linear_psf`.
#include "device/device_backend.h"
#include "methods/linear.h"
#include "methods/linear_source.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// A radius and scaled colours are read; colours are written.
const LaunchRow linear_psf_launch({.kernel = "linear_psf",
                                   .group = {16, 1},
                                   .bytes_a_surface = Launch::plane + Launch::colour,
                                   .run_px = DEFRAY_RUN,
                                   .bytes_a_target = Launch::colour,
                                   .rows_at_once = 16,
                                   .reads_padded = true});

}  // namespace

Planes DeviceBackend::linear(const Frame& f, const Progress& progress) {
  const int reach = linear_reach(f.coc_quanta.host());
  require_row(session_, "linear_psf", f, reach);
  const std::size_t stride = launch_of("linear_psf").row_values(size(f.width), reach);
  const DiscNorms norm(reach + 1);
  Planes out;
  const auto work = [&](Band& band) {
    const BandRows& rows = band.rows();
    const LinearSource source(f, rows, reach, stride, norm);
    const DefrayLinearParams p{.width = word(f.width),
                               .window_rows = word(rows.window_rows),
                               .band_row = word(rows.y - rows.window_y),
                               .band_rows = word(rows.rows),
                               .source_stride = static_cast<std::uint32_t>(stride),
                               .reach = reach};
    const auto scaled = four_channels(
        source.scaled.size(), [&](std::size_t c) { return session_.view(source.scaled[c]); });
    Band own = band.own();
    const auto made = own.out(out, f.channels.size());
    own.launch(p, session_.view(source.row_reach), session_.view(source.radius), scaled, made);
    session_.finish();  // the source is this function's own
  };
  for_each_band(session_, "linear_psf", f, reach, work, 1, progress);
  return out;
}

}  // namespace defray
