// Kernel `split`.
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

// A square around, and what is beside its pixels. Two layers are written, the frame and
// what lies behind read.
const LaunchRow split_launch({.kernel = "split",
                              .group = {64, 1},
                              .reach_px = DEFRAY_SPLIT_THIN_PX + 1,
                              .bytes_a_surface = 3 * Launch::plane + Launch::colour +
                                                 (5 * Launch::plane + 2 * Launch::colour) / 2});

}  // namespace

Frame DeviceBackend::split(const Frame& f, const Words& mixed, const Frame& behind, Frame into) {
  Frame layers = into.width > 0 ? std::move(into) : f.without_planes();
  layers.layers = 2;
  layers.wanted = f.wanted;
  for_each_band(session_, "split", layers, 0, [&](Band& band) {
    const BandRows& rows = band.rows();
    const cl::Buffer coc = band.out(layers.coc_quanta), depth = band.out(layers.depth);
    const cl::Buffer coverage = band.out(layers.coverage);
    const auto colour = band.out(layers.channels, f.channels.size());
    const DefraySplitParams p{word(f.width), word(rows.window_rows), word(rows.window_y),
                              word(f.height), word(f.margin)};
    Band pixels(session_, "split", f, rows);  // a work-item each
    pixels.launch(p, pixels.in(f.coc_quanta), pixels.in(f.inverse), pixels.in(mixed),
                  pixels.in(f.channels), pixels.in(behind.coc_quanta), pixels.in(behind.inverse),
                  pixels.in(behind.channels), coc, depth, coverage, colour);
    band.collect();
  });
  return layers;
}

}  // namespace defray
