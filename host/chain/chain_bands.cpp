#include "chain/chain_bands.h"

#include <algorithm>

#include "chain/fill_tiles.h"
#include "chain/highlight_tiles.h"
#include "chain/patterns.h"
#include "lens/coc.h"
#include "lens/lens_grid.h"
#include "opencl/launch_table.h"
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
  if (s.hidden != Hidden::off) reach.fill = fill_rows(reach.seen);
  if (s.hidden == Hidden::patterns) reach.patterns = pattern_rows_around(PatternSettings());
  if (s.highlights) reach.highlights = highlight_reach(largest);
  if (s.soften) {
    const float side = static_cast<float>(largest) * px_per_quantum / cells_per_side(lens_points);
    reach.soften = static_cast<int>(side) + launch_of("soften").reach_px + 1;
  }
  reach.rays = rdb_reach(largest) + 2;
  return reach;
}

std::size_t bytes_of_bands(const Frame& e, std::size_t channels, const ChainReach& reach,
                           int rows) {
  const auto plane = [&](std::int64_t count) {
    return sizeof(float) * size(e.width) *
           static_cast<std::size_t>(std::min<std::int64_t>(count, e.height));
  };
  const std::int64_t fill = reach.fill, patterns = reach.patterns;
  const std::int64_t sent = rows + 2 * std::int64_t{reach.rays};
  const std::int64_t layered = sent + reach.soften + 2 * std::int64_t{reach.highlights};
  const std::size_t layers = reach.fill > 0 ? 2 : 1;
  // CoC before and after the repair, where from, 1/depth, mixed, data.
  const std::size_t front = (6 + channels) * plane(rows + std::max(fill, patterns) + fill);
  const std::size_t behind =
      layers < 2 ? 0 : (2 + channels) * plane(rows + patterns) + plane(rows + 2 * patterns);
  // CoC, depth, coverage, data, what highlights keep, alpha.
  const std::size_t layer = (6 + channels) * plane(layered);
  const std::size_t softened = channels * plane(sent);
  // What rdb_pad writes, of four channels those that there are.
  const std::size_t padded =
      (launch_of("rdb_pad").bytes_a_surface / Launch::plane - 4 + channels) * plane(sent);
  const std::size_t result = (2 + channels) * plane(rows);
  return front + behind + layers * (layer + softened + padded) + result;
}

int chain_rows(const Frame& e, std::size_t channels, const ChainReach& reach,
               std::size_t memory_bytes) {
  if (bytes_of_bands(e, channels, reach, e.height) <= memory_bytes) return e.height;
  int rows = band_step;
  while (rows < e.height &&
         bytes_of_bands(e, channels, reach, rows + band_step) <= memory_bytes / 2) {
    rows += band_step;
  }
  return std::min(rows, e.height);
}

}  // namespace defray
