// Kernels `gather_aware` and `gather_literal`: pass after pass, each over all bands.
#include "methods/gather.h"

#include <algorithm>

#include "base/parallel.h"
#include "device/device_backend.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

/// What both gathers need: they read radii and packed colours, and write these for the band alone.
Launch gather_launch(const char* kernel, int reach_px) {
  return {.kernel = kernel,
          .group = {8, 1},
          .reach_px = reach_px,
          .bytes_a_surface = Launch::plane + Launch::colour,
          .run_px = DEFRAY_RUN,
          .bytes_a_target = Launch::colour,
          .bytes_a_value = Launch::colour,
          .rows_at_once = 128};
}

// 1: a radius ends within a pixel, which samples are rounded to.
const LaunchRow gather_aware_launch(gather_launch("gather_aware", 1));
// 2: colours lie between that pixel and the next, and products are rounded.
const LaunchRow gather_literal_launch(gather_launch("gather_literal", 2));

/// Four channels of each pixel together, as samples fetch them.
using Packed = Values<cl_float4>;

Packed packed(const Planes& channels) {
  const auto planes =
      four_channels(channels.size(), [&](std::size_t c) { return channels[c].host(); });
  std::vector<cl_float4> colours(planes[0].size());
  parallel_for_each(colours.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < 4; ++c) colours[i].s[c] = planes[c][i];
  });
  return colours;
}

Planes unpacked(const Packed& packed, std::size_t channels) {
  const std::span<const cl_float4> colours = packed.host();
  std::vector<Plane> planes(channels, Plane(colours.size()));
  parallel_for_each(colours.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < channels; ++c) planes[c][i] = colours[i].s[c];
  });
  return planes;
}

}  // namespace

Planes DeviceBackend::gather(const Frame& f, const GatherSettings& settings,
                             const Progress& progress) {
  validate(settings);
  const bool is_aware = settings.kind == GatherKind::aware;
  const char* const kernel = is_aware ? "gather_aware" : "gather_literal";
  const int reach_px = gather_reach_px(f);
  require_row(session_, kernel, f, reach_px);
  const GatherSamples samples = make_gather_samples(settings);
  const cl::Buffer points = session_.view(samples.points), turns = session_.view(samples.turns);
  const Quanta reach = is_aware ? gather_reach(f) : Quanta();
  Packed colour = packed(f.channels);
  for (int pass = 0; pass < settings.passes; ++pass) {
    DefrayGatherParams p = gather_params(settings, f.width, pass);
    Packed out;
    const auto work = [&](Band& band) {
      const BandRows& rows = band.rows();
      p.window_y = word(rows.window_y);
      p.window_rows = word(rows.window_rows);
      p.band_y = word(rows.y);
      p.band_rows = word(rows.rows);
      Band own = band.own();
      const cl::Buffer made = own.out(out), coc = band.in(f.coc_quanta), source = band.in(colour);
      if (is_aware) {
        own.launch(p, coc, session_.in(reach), points, turns, source, made);
      } else {
        own.launch(p, coc, points, turns, source, made);
      }
    };
    const auto share = [&](double done) { progress((pass + done) / settings.passes); };
    for_each_band(session_, kernel, f, reach_px, work, 1, progress ? Progress(share) : Progress());
    colour = std::move(out);
  }
  return unpacked(colour, f.channels.size());
}

}  // namespace defray
