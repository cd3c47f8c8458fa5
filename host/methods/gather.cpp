#include "methods/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "lens/poisson_disk.h"

namespace defray {
namespace {

/// Rows of a launch: enough work to fill a device, few enough for a progress bar to move.
constexpr int rows_per_launch = 128;

std::uint32_t tiles_across(int pixels) {
  return static_cast<std::uint32_t>((pixels + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE);
}

/// A pass's radius, in CoC radii. The paper repeats the whole blur "to strengthen the effect".
/// Where depth counts, the passes share it: each after the first fills the discs that single
/// samples of the one before stand for, and the squares of all add up to 1, as variances do.
double pass_radius(const GatherSettings& s, int pass) {
  if (s.kind == GatherKind::literal) return 1;
  const double share = 1.0 / s.samples;
  if (pass > 0) return std::sqrt(std::pow(share, pass));
  double rest = 1;
  for (int later = 1; later < s.passes; ++later) rest -= std::pow(share, later);
  return std::sqrt(std::max(rest, 0.0));
}

/// What stays on the device from pass to pass.
struct GatherBuffers {
  cl::Buffer coc, reach, points, turns;
};

/// One pass over the frame.
std::vector<Plane> gather_once(Session& session, DefrayGatherParams p, GatherKind kind,
                               const GatherBuffers& shared, const std::vector<Plane>& channels,
                               const std::function<void(double)>& progress) {
  const int width = static_cast<int>(p.width), height = static_cast<int>(p.height);
  cl::Buffer in[4];
  // The kernel always takes four channels; a missing one repeats the last and is not read back.
  for (std::size_t c = 0; c < 4; ++c) {
    in[c] =
        c < channels.size() ? session.picture(channels[c].data(), channels[c].size()) : in[c - 1];
  }
  const int most_rows = std::min(rows_per_launch, height);
  std::vector<cl_float4> band(static_cast<std::size_t>(width) *
                              static_cast<std::size_t>(most_rows));
  const cl::Buffer out = session.buffer(band.size() * sizeof(cl_float4));
  std::vector<Plane> result(channels.size(), Plane(channels[0].size()));
  for (int y = 0; y < height; y += rows_per_launch) {
    p.band_y = static_cast<std::uint32_t>(y);
    p.band_rows = static_cast<std::uint32_t>(std::min(rows_per_launch, height - y));
    const std::size_t count = std::size_t{p.width} * p.band_rows;
    if (kind == GatherKind::literal) {
      session.launch("gather_literal", DEFRAY_GATHER_GROUP, {p.width, p.band_rows}, p, shared.coc,
                     shared.points, shared.turns, in[0], in[1], in[2], in[3], out);
    } else {
      session.launch("gather_aware", DEFRAY_GATHER_GROUP, {p.width, p.band_rows}, p, shared.coc,
                     shared.reach, shared.points, shared.turns, in[0], in[1], in[2], in[3], out);
    }
    session.read(out, band.data(), count * sizeof(cl_float4));
    const std::size_t first = static_cast<std::size_t>(y) * p.width;
    for (std::size_t c = 0; c < result.size(); ++c) {
      for (std::size_t i = 0; i < count; ++i) result[c][first + i] = band[i].s[c];
    }
    if (progress) progress(static_cast<double>(p.band_y + p.band_rows) / height);
  }
  return result;
}

}  // namespace

void validate(const GatherSettings& s) {
  if (s.samples < 1 || s.samples > poisson_disk_max_count) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to {}", field("samples"), s.samples,
         poisson_disk_max_count);
  }
  if (s.passes < 1 || s.passes > gather_max_passes) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to {}", field("passes"), s.passes,
         gather_max_passes);
  }
}

GatherSamples make_gather_samples(const GatherSettings& settings) {
  GatherSamples samples;
  for (const auto& p : make_poisson_disk(settings.samples, settings.seed).points) {
    samples.points.push_back({static_cast<float>(p[0]), static_cast<float>(p[1])});
  }
  for (int i = 0; i < DEFRAY_GATHER_ROTATIONS; ++i) {
    const double angle = 2 * std::numbers::pi * i / DEFRAY_GATHER_ROTATIONS;
    samples.turns.push_back(
        {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
  }
  return samples;
}

DefrayGatherParams gather_params(const GatherSettings& settings, int width, int height, int pass) {
  DefrayGatherParams p{};
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
  p.band_rows = p.height;
  p.sample_count = static_cast<std::uint32_t>(settings.samples);
  p.rotates = settings.rotate ? 1 : 0;
  p.seed = settings.seed + static_cast<std::uint32_t>(pass);
  p.radius_scale = static_cast<float>(pass_radius(settings, pass));
  return p;
}

DefrayTileParams tile_params(int width, int height, std::int32_t largest_coc_quanta) {
  DefrayTileParams p{};
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
  p.tiles_x = tiles_across(width);
  p.tiles_y = tiles_across(height);
  const int most = static_cast<int>(std::max(p.tiles_x, p.tiles_y));
  const int reach_px = largest_coc_quanta >> DEFRAY_COC_FRACTION_BITS;
  p.reach_tiles = std::min(most, reach_px / DEFRAY_GATHER_TILE + 1);
  return p;
}

std::vector<std::int32_t> gather_tiles_on_device(Session& session, int width, int height,
                                                 const std::vector<std::int32_t>& coc_quanta) {
  const DefrayTileParams p = tile_params(width, height, largest_coc(coc_quanta));
  std::vector<std::int32_t> largest(std::size_t{p.tiles_x} * p.tiles_y);
  const cl::Buffer out = session.buffer(largest.size() * sizeof(std::int32_t));
  session.launch("gather_tiles", DEFRAY_GATHER_REACH_GROUP, {p.tiles_x, p.tiles_y}, p,
                 session.view(coc_quanta), out);
  session.read(out, largest.data(), largest.size() * sizeof(std::int32_t));
  return largest;
}

std::vector<std::int32_t> gather_reach_on_device(Session& session, int width, int height,
                                                 const std::vector<std::int32_t>& coc_quanta) {
  DefrayTileParams p = tile_params(width, height, largest_coc(coc_quanta));
  std::vector<std::int32_t> reach = gather_tiles_on_device(session, width, height, coc_quanta);
  const std::vector<std::int32_t> largest = reach;
  const cl::Buffer along_x = session.buffer(reach.size() * sizeof(std::int32_t));
  const cl::Buffer out = session.buffer(reach.size() * sizeof(std::int32_t));
  session.launch("gather_reach", DEFRAY_GATHER_REACH_GROUP, {p.tiles_x, p.tiles_y}, p,
                 session.view(largest), along_x);
  p.along_y = 1;
  session.launch("gather_reach", DEFRAY_GATHER_REACH_GROUP, {p.tiles_x, p.tiles_y}, p, along_x,
                 out);
  session.read(out, reach.data(), reach.size() * sizeof(std::int32_t));
  return reach;
}

std::vector<Plane> render_gather(Session& session, int width, int height,
                                 const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels, const GatherSettings& settings,
                                 const std::function<void(double)>& progress) {
  validate(settings);
  const GatherSamples samples = make_gather_samples(settings);
  std::vector<std::int32_t> reach{0};  // literal looks no farther than its own CoC
  if (settings.kind == GatherKind::aware) {
    reach = gather_reach_on_device(session, width, height, coc_quanta);
  }
  const GatherBuffers shared{session.view(coc_quanta), session.view(reach),
                             session.view(samples.points), session.view(samples.turns)};
  std::vector<Plane> result = channels;
  for (int pass = 0; pass < settings.passes; ++pass) {
    const auto share = [&](double done) {
      if (progress) progress((pass + done) / settings.passes);
    };
    result = gather_once(session, gather_params(settings, width, height, pass), settings.kind,
                         shared, result, share);
  }
  return result;
}

}  // namespace defray
