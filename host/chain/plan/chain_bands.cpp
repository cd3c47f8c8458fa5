#include "chain/plan/chain_bands.h"

#include <algorithm>

#include "chain/patterns/patterns.h"
#include "chain/silhouettes/silhouettes.h"
#include "chain/tiles/fill_tiles.h"
#include "chain/tiles/highlight_tiles.h"
#include "lens/coc.h"
#include "lens/lens_grid.h"
#include "opencl/launch_table.h"
#include "rdb/light_sources.h"
#include "rdb/rdb_plan.h"

namespace defray {
namespace {

/// `fill` continues the slant of what it finds by half the step to it at most.
CocRange with_made_up(CocRange range) {
  const std::int32_t step = tame(range.largest) - tame(range.least);
  range.largest = std::max(range.largest, tame(range.largest) + step / 2 + 1);
  return range;
}

}  // namespace

ChainReach chain_reach(const Frame& f, const ChainSettings& s, int lens_points) {
  ChainReach reach{.seen = f.coc_range(), .all = {}};
  reach.all = s.hidden == Hidden::off ? reach.seen : with_made_up(reach.seen);
  const std::int32_t largest = reach.all.largest_radius();
  if (s.hidden != Hidden::off) {
    reach.silhouettes = silhouette_rows();
    reach.fill = fill_rows(reach.seen);
  }
  if (s.hidden == Hidden::patterns) reach.patterns = pattern_rows_around(PatternSettings());
  if (s.highlights) reach.highlights = highlight_reach(largest);
  if (s.soften) {
    const float side = static_cast<float>(largest) * px_per_quantum / cells_per_side(lens_points);
    reach.soften = static_cast<int>(side) + launch_of("soften").reach_px + 1;
  }
  reach.rays = rdb_reach(largest) + light_map_rows(largest);
  return reach;
}

std::size_t bytes_of_bands(const Frame& e, const PlaneCounts& planes, const ChainReach& reach,
                           const ChainBands& bands) {
  const auto plane = [&](std::int64_t rows) {
    return sizeof(float) * size(e.width) *
           static_cast<std::size_t>(std::min<std::int64_t>(rows, e.height));
  };
  const std::size_t channels = planes.channels, data = planes.has_data;
  const bool has_behind = reach.fill > 0;
  const std::int64_t silhouettes = reach.silhouettes, fill = reach.fill, patterns = reach.patterns;
  // A stage that is ahead of another is so by whole steps.
  const std::int64_t rows = bands.rows < e.height ? bands.rows + 2 * band_step : bands.rows;
  const std::int64_t ahead = silhouettes + fill;
  // CoC, what of it is to be repaired, 1/depth, mixed.
  const std::size_t front =
      (4 + data + channels) * plane(rows + ahead + std::max({fill, silhouettes, 2 * patterns}));
  const std::int64_t feather = launch_of("feather").reach_px;
  // What fill is told and strips, what it makes, what patterns are told, what feather makes.
  const std::size_t behind = 2 * plane(rows + fill + std::max(fill, patterns + 2 * feather)) +
                             (2 + channels) * plane(rows + patterns + 2 * feather) +
                             (patterns > 0 ? plane(rows + 2 * patterns) : 0) +
                             channels * plane(rows);
  const std::size_t front_and_behind = front + (has_behind ? behind : 0);
  const std::int64_t sent = rows + 2 * std::int64_t{reach.rays};
  const std::int64_t layered = sent + reach.soften + 2 * std::int64_t{reach.highlights};
  // CoC, depth, coverage; what highlights keep, and alpha.
  const std::size_t of_highlights = reach.highlights > 0 ? 1 + std::size_t{planes.has_alpha} : 0;
  const std::size_t layer = (3 + data + of_highlights + channels) * plane(layered);
  const std::size_t softened = reach.soften > 0 ? channels * plane(sent) : 0;
  // What rdb_pad writes, of four channels those that there are.
  const std::size_t padded =
      (launch_of("rdb_pad").bytes_a_surface / Launch::plane - 4 + channels) * plane(sent);
  const std::size_t layers = has_behind ? 2 : 1, result = (2 + channels) * plane(bands.rows);
  const std::size_t sending = layers * padded + result;
  // Where nothing lies behind, the front's planes are the only layer and stay. Between bands the
  // allocator keeps what rays took for those of the next, so that it counts beside the stages'.
  if (bands.gives_back && has_behind && bands.rows >= e.height) {
    return layers * (layer + softened) + std::max(front_and_behind, sending);
  }
  return layers * (layer + softened) + front_and_behind + sending;
}

ChainBands chain_bands(const Frame& e, const PlaneCounts& planes, const ChainReach& reach,
                       std::size_t memory_bytes) {
  const auto fits = [&](const ChainBands& bands, std::size_t bytes) {
    return bytes_of_bands(e, planes, reach, bands) <= bytes;
  };
  for (const bool gives_back : {false, true}) {
    if (fits({e.height, gives_back}, memory_bytes)) return {e.height, gives_back};
  }
  ChainBands bands{band_step, true};
  while (bands.rows < e.height && fits({bands.rows + band_step, true}, memory_bytes / 4 * 3)) {
    bands.rows += band_step;
  }
  bands.rows = std::min(bands.rows, e.height);
  return bands;
}

}  // namespace defray
