#include "splat/splats.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace defray {
namespace {

bool has_pixels(const DefraySplat& s) { return s.first_x < s.end_x && s.first_y < s.end_y; }

/// Calls visit(tile) for each tile that a splat's pixels lie in.
template <typename Visit>
void for_each_tile(const DefraySplat& s, int tiles_x, const Visit& visit) {
  const int last_x = (s.end_x - 1) / DEFRAY_SPLAT_TILE, last_y = (s.end_y - 1) / DEFRAY_SPLAT_TILE;
  for (int y = s.first_y / DEFRAY_SPLAT_TILE; y <= last_y; ++y) {
    for (int x = s.first_x / DEFRAY_SPLAT_TILE; x <= last_x; ++x) visit(word(y * tiles_x + x));
  }
}

}  // namespace

std::vector<DefraySplat> in_order(const std::vector<DefraySplat>& splats) {
  // Depths are above 0: their bits are in the order of their values.
  std::vector<std::uint64_t> keys;
  for (std::uint32_t i = 0; i < splats.size(); ++i) {
    if (!has_pixels(splats[i])) continue;
    keys.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(splats[i].z_near)} << 32 | i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<DefraySplat> sorted;
  sorted.reserve(keys.size());
  for (const std::uint64_t key : keys) sorted.push_back(splats[key & 0xffffffffu]);
  return sorted;
}

std::vector<std::uint32_t> splats_a_tile(const std::vector<DefraySplat>& splats, int tiles_x,
                                         int tiles_y) {
  std::vector<std::uint32_t> counts(size(tiles_x) * size(tiles_y));
  for (const DefraySplat& s : splats) {
    for_each_tile(s, tiles_x, [&](std::uint32_t tile) { ++counts[tile]; });
  }
  return counts;
}

SplatTiles next_tiles(const std::vector<DefraySplat>& splats,
                      const std::vector<std::uint32_t>& counts, int tiles_x,
                      std::uint32_t first_tile, std::size_t most) {
  SplatTiles tiles{first_tile, 0, {0}, {}};
  std::size_t entries = 0;
  while (first_tile + tiles.tile_count < counts.size()) {
    const std::uint32_t more = counts[first_tile + tiles.tile_count];
    if (tiles.tile_count > 0 && entries + more > most) break;
    entries += more;
    ++tiles.tile_count;
    tiles.first.push_back(static_cast<std::uint32_t>(entries));
  }
  tiles.list.resize(entries);
  std::vector<std::uint32_t> next(tiles.first.begin(), tiles.first.end() - 1);
  for (std::uint32_t i = 0; i < splats.size(); ++i) {
    for_each_tile(splats[i], tiles_x, [&](std::uint32_t tile) {
      const std::uint32_t t = tile - first_tile;  // wraps round below the first
      if (t < tiles.tile_count) tiles.list[next[t]++] = i;
    });
  }
  return tiles;
}

}  // namespace defray
