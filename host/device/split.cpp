// Kernels `split` and `assemble`.
#include "device/device_backend.h"
#include "opencl/bands.h"

namespace defray {

Surfaces DeviceBackend::split(const Frame& f, const Words& mixed, Frame behind) {
  Frame front = f.without_planes();
  for_each_band(session_, "split", f, 0, [&](Band& band) {
    const DefrayFrameParams p{word(f.width), word(band.rows().window_rows)};
    const cl::Buffer behind_coc = band.in_out(behind.coc_quanta);
    const cl::Buffer behind_inverse = band.in_out(behind.inverse);
    const auto behind_colour = band.in_out(behind.channels);
    const cl::Buffer behind_coverage = band.out(behind.coverage);
    const cl::Buffer coc = band.out(front.coc_quanta), inverse = band.out(front.inverse);
    const auto colour = band.out(front.channels, f.channels.size());
    const cl::Buffer coverage = band.out(front.coverage);
    band.launch(p, band.in(f.coc_quanta), band.in(f.inverse), band.in(mixed), band.in(f.channels),
                behind_coc, behind_inverse, behind_colour, behind_coverage, coc, inverse, colour,
                coverage);
  });
  return {std::move(front), std::move(behind)};
}

Frame DeviceBackend::assemble(const Surfaces& s) {
  Frame f = s.front.without_planes();
  f.layers = 2;
  const std::size_t channels = s.front.channels.size();
  for_each_band(session_, "assemble", f, 0, [&](Band& band) {
    const BandRows& rows = band.rows();
    const cl::Buffer coc = band.out(f.coc_quanta), depth = band.out(f.depth);
    const cl::Buffer coverage = band.out(f.coverage);
    const auto colour = band.out(f.channels, channels);
    Band front(session_, "assemble", s.front, rows), behind(session_, "assemble", s.behind, rows);
    const DefrayAssembleParams p{word(f.width), word(rows.window_rows), word(rows.window_y),
                                 word(f.height), word(f.margin)};
    band.launch(
        p, front.in(s.front.coc_quanta), front.in(s.front.inverse), front.in(s.front.coverage),
        front.in(s.front.channels), behind.in(s.behind.coc_quanta), behind.in(s.behind.inverse),
        behind.in(s.behind.coverage), behind.in(s.behind.channels), coc, depth, coverage, colour);
  });
  return f;
}

}  // namespace defray
