// Kernels `gather_*`: pass after pass, in bands of rows.
#include "methods/gather.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "device/device_backend.h"
#include "lens/coc.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow gather_aware_launch({"gather_aware", WorkGroup{8, 1}});
const LaunchRow gather_literal_launch({"gather_literal", WorkGroup{8, 1}});
const LaunchRow gather_reach_launch({"gather_reach", WorkGroup{16, 1}});
const LaunchRow gather_tiles_launch({"gather_tiles", WorkGroup{16, 1}});

/// Rows of a launch: enough work to fill a device, few enough for a progress bar to move.
constexpr std::uint32_t gather_rows_per_launch = 128;

/// What stays on the device from pass to pass.
struct GatherBuffers {
  cl::Buffer coc, reach, points, turns;
};

/// Four channels of each pixel together, as samples fetch them; a missing one repeats the last.
std::vector<cl_float4> packed_colours(const Planes& channels) {
  std::array<std::span<const float>, 4> planes;
  for (std::size_t c = 0; c < 4; ++c) planes[c] = channels[std::min(c, channels.size() - 1)].host();
  std::vector<cl_float4> packed(planes[0].size());
  parallel_for_each(packed.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < 4; ++c) packed[i].s[c] = planes[c][i];
  });
  return packed;
}

std::vector<Plane> planes_of(std::span<const cl_float4> packed, std::size_t channels) {
  std::vector<Plane> planes(channels, Plane(packed.size()));
  parallel_for_each(packed.size(), [&](std::size_t i) {
    for (std::size_t c = 0; c < channels; ++c) planes[c][i] = packed[i].s[c];
  });
  return planes;
}

/// One pass over the frame.
void gather_once(Session& session, DefrayGatherParams p, GatherKind kind,
                 const GatherBuffers& shared, const cl::Buffer& colour, const cl::Buffer& out,
                 const Progress& progress) {
  const std::size_t runs = (std::size_t{p.width} + DEFRAY_RUN - 1) / DEFRAY_RUN;
  for (; p.band_y < p.height; p.band_y += gather_rows_per_launch) {
    p.band_rows = std::min(gather_rows_per_launch, p.height - p.band_y);
    if (kind == GatherKind::literal) {
      session.launch("gather_literal", {runs, p.band_rows}, p, shared.coc, shared.points,
                     shared.turns, colour, out);
    } else {
      session.launch("gather_aware", {runs, p.band_rows}, p, shared.coc, shared.reach,
                     shared.points, shared.turns, colour, out);
    }
    if (!progress) continue;
    session.finish();
    progress(static_cast<double>(p.band_y + p.band_rows) / p.height);
  }
}

}  // namespace

std::vector<std::int32_t> DeviceBackend::gather_tiles(const Frame& f) {
  const DefrayTileParams p = tile_params(f.width, f.height, largest_coc(f.coc_quanta.host()));
  Quanta largest;
  const cl::Buffer out = session_.out(largest, std::size_t{p.tiles_x} * p.tiles_y);
  session_.launch("gather_tiles", {p.tiles_x, p.tiles_y}, p, session_.in(f.coc_quanta), out);
  return std::move(largest).take();
}

std::vector<std::int32_t> DeviceBackend::gather_reach(const Frame& f) {
  DefrayTileParams p = tile_params(f.width, f.height, largest_coc(f.coc_quanta.host()));
  const std::vector<std::int32_t> largest = gather_tiles(f);
  const cl::Buffer along_x = session_.buffer(largest.size() * sizeof(std::int32_t));
  Quanta reach;
  const cl::Buffer out = session_.out(reach, largest.size());
  session_.launch("gather_reach", {p.tiles_x, p.tiles_y}, p, session_.view(largest), along_x);
  p.along_y = 1;
  session_.launch("gather_reach", {p.tiles_x, p.tiles_y}, p, along_x, out);
  return std::move(reach).take();
}

std::vector<Plane> DeviceBackend::gather(const Frame& f, const GatherSettings& settings,
                                         const Progress& progress) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<std::int32_t> reach{0};  // literal looks no farther than its own CoC
  if (settings.kind == GatherKind::aware) reach = gather_reach(f);
  const GatherBuffers shared{session_.in(f.coc_quanta), session_.view(reach),
                             session_.view(samples.points), session_.view(samples.turns)};
  const std::vector<cl_float4> packed = packed_colours(f.channels);
  const std::size_t bytes = packed.size() * sizeof(cl_float4);
  std::array<cl::Buffer, 2> made{session_.buffer(bytes)};
  if (settings.passes > 1) made[1] = session_.buffer(bytes);
  cl::Buffer colour = session_.view(packed);
  for (int pass = 0; pass < settings.passes; ++pass) {
    const auto share = [&](double done) {
      if (progress) progress((pass + done) / settings.passes);
    };
    const cl::Buffer& out = made[size(pass % 2)];
    gather_once(session_, gather_params(settings, f.width, f.height, pass), settings.kind, shared,
                colour, out, share);
    colour = out;
  }
  std::vector<Plane> result;
  session_.look_at<cl_float4>(colour, packed.size(), [&](std::span<const cl_float4> pixels) {
    result = planes_of(pixels, f.channels.size());
  });
  return result;
}

}  // namespace defray
