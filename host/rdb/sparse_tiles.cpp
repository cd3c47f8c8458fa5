#include "rdb/sparse_tiles.h"

#include <algorithm>

namespace defray {
namespace {

constexpr int tile_px = DEFRAY_RAY_TILE;

/// Tiles on each side from which rays of smaller radii may come; they land a pixel farther at most.
int tiles_in_reach(std::int32_t radius) {
  return (radius >> DEFRAY_COC_FRACTION_BITS) / tile_px + 1;
}

/// The least of each tile and of so many around, along x and then along y.
std::vector<std::int32_t> least_around(std::vector<std::int32_t> least, const TileWindow& window,
                                       int reach) {
  for (const bool along_y : {false, true}) {
    const std::vector<std::int32_t> own = least;
    const int count = along_y ? window.down : window.across;
    for (int i = 0; i < window.across * window.down; ++i) {
      const int here = along_y ? i / window.across : i % window.across;
      const int step = along_y ? window.across : 1;
      for (int at = std::max(here - reach, 0); at <= std::min(here + reach, count - 1); ++at) {
        least[size(i)] = std::min(least[size(i)], own[size(i + (at - here) * step)]);
      }
    }
  }
  return least;
}

}  // namespace

std::vector<std::uint32_t> sparse_tiles(const std::vector<std::int32_t>& least,
                                        const TileWindow& window, const Frame& f,
                                        const RayPlan& plan) {
  std::vector<std::uint32_t> sparsity(least.size(), 0);
  if (plan.sparse_from[0] == 0 || plan.wants_nearest) return sparsity;
  for (std::uint32_t level = 1; level <= plan.sparse_from.size(); ++level) {
    const std::int32_t from = plan.sparse_from[level - 1];
    const auto around = least_around(least, window, tiles_in_reach(from));
    for (std::size_t i = 0; i < least.size(); ++i) {
      if (around[i] >= from) sparsity[i] = level;
    }
  }
  for (int i = 0; i < window.across * window.down; ++i) {
    const int y = window.y + i / window.across * tile_px;
    const bool is_in_picture = y >= f.margin && y + tile_px <= f.height - f.margin;
    if (!is_in_picture) sparsity[size(i)] = 0;
  }
  return sparsity;
}

std::size_t interpolated_pixels(const std::vector<std::uint32_t>& sparsity,
                                const TileWindow& window, const Frame& f, Rows wanted) {
  std::size_t count = 0;
  for (int i = 0; i < window.across * window.down; ++i) {
    const int x = i % window.across * tile_px, y = window.y + i / window.across * tile_px;
    if (sparsity[size(i)] == 0 || y < wanted.y || y >= wanted.end) continue;
    const int columns = std::min(x + tile_px, f.width - f.margin) - std::max(x, f.margin);
    const int rows = tile_px - (tile_px >> sparsity[size(i)]);
    if (columns > 0) count += size(columns) * size(rows);
  }
  return count;
}

}  // namespace defray
