// Kernels `gather_*`: pass after pass, in bands of rows.
#include "methods/gather.h"

#include <algorithm>
#include <array>

#include "device/device_stages.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// Rows of a launch: enough work to fill a device, few enough for a progress bar to move.
constexpr int gather_rows_per_launch = 128;

/// What stays on the device from pass to pass.
struct GatherBuffers {
  cl::Buffer coc, reach, points, turns;
};

/// One pass over the frame.
std::vector<Plane> gather_once(Session& session, DefrayGatherParams p, GatherKind kind,
                               const GatherBuffers& shared, const Planes& channels,
                               const Progress& progress) {
  const int width = static_cast<int>(p.width), height = static_cast<int>(p.height);
  std::array<cl::Buffer, 4> in;
  // The kernel always takes four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    in[c] = c < channels.size() ? session.in(channels[c]) : in[c - 1];
  }
  const std::size_t most = size(width) * size(std::min(gather_rows_per_launch, height));
  const cl::Buffer out = session.buffer(most * sizeof(cl_float4));
  std::vector<Plane> result(channels.size(), Plane(channels[0].size()));
  for (int y = 0; y < height; y += gather_rows_per_launch) {
    p.band_y = word(y);
    p.band_rows = word(std::min(gather_rows_per_launch, height - y));
    const std::size_t count = std::size_t{p.width} * p.band_rows;
    if (kind == GatherKind::literal) {
      session.launch("gather_literal", {p.width, p.band_rows}, p, shared.coc, shared.points,
                     shared.turns, in, out);
    } else {
      session.launch("gather_aware", {p.width, p.band_rows}, p, shared.coc, shared.reach,
                     shared.points, shared.turns, in, out);
    }
    const std::size_t first = size(y) * p.width;
    session.look_at<cl_float4>(out, count, [&](std::span<const cl_float4> band) {
      for (std::size_t c = 0; c < result.size(); ++c) {
        for (std::size_t i = 0; i < count; ++i) result[c][first + i] = band[i].s[c];
      }
    });
    if (progress) progress(static_cast<double>(p.band_y + p.band_rows) / height);
  }
  return result;
}

}  // namespace

std::vector<std::int32_t> DeviceStages::gather_tiles(const Frame& f) {
  const DefrayTileParams p = tile_params(f.width, f.height, largest_coc(f.coc_quanta.host()));
  Quanta largest;
  const cl::Buffer out = session_.out(largest, std::size_t{p.tiles_x} * p.tiles_y);
  session_.launch("gather_tiles", {p.tiles_x, p.tiles_y}, p, session_.in(f.coc_quanta), out);
  return std::move(largest).take();
}

std::vector<std::int32_t> DeviceStages::gather_reach(const Frame& f) {
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

std::vector<Plane> DeviceStages::gather(const Frame& f, const GatherSettings& settings,
                                        const Progress& progress) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<std::int32_t> reach{0};  // literal looks no farther than its own CoC
  if (settings.kind == GatherKind::aware) reach = gather_reach(f);
  const GatherBuffers shared{session_.in(f.coc_quanta), session_.view(reach),
                             session_.view(samples.points), session_.view(samples.turns)};
  Planes channels = f.channels;
  std::vector<Plane> result;
  for (int pass = 0; pass < settings.passes; ++pass) {
    const auto share = [&](double done) {
      if (progress) progress((pass + done) / settings.passes);
    };
    result = gather_once(session_, gather_params(settings, f.width, f.height, pass), settings.kind,
                         shared, channels, share);
    channels = Planes::view(result);
  }
  return result;
}

}  // namespace defray
