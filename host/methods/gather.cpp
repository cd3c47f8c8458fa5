#include "methods/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "lens/poisson_disk.h"

namespace defray {
namespace {

int tiles_across(int pixels) { return (pixels + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE; }

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

DefrayGatherParams gather_params(const GatherSettings& settings, int width, int pass) {
  DefrayGatherParams p{};
  p.width = word(width);
  p.sample_count = word(settings.samples);
  p.rotates = settings.rotate ? 1 : 0;
  p.seed = settings.seed + static_cast<std::uint32_t>(pass);
  p.radius_scale = static_cast<float>(pass_radius(settings, pass));
  return p;
}

int gather_reach_px(const Frame& frame) {
  return frame.coc_range().largest_radius() >> DEFRAY_COC_FRACTION_BITS;
}

Frame gather_tiles_of(const Frame& frame) {
  return {.width = tiles_across(frame.width), .height = tiles_across(frame.height)};
}

DefrayTileParams tile_params(int width, int height, std::int32_t largest_coc_quanta) {
  DefrayTileParams p{};
  p.width = word(width);
  p.height = word(height);
  p.tiles_x = word(tiles_across(width));
  p.tiles_y = word(tiles_across(height));
  const int most = static_cast<int>(std::max(p.tiles_x, p.tiles_y));
  const int reach_px = largest_coc_quanta >> DEFRAY_COC_FRACTION_BITS;
  p.reach_tiles = std::min(most, reach_px / DEFRAY_GATHER_TILE + 1);
  return p;
}

}  // namespace defray
