#include "splat/splats.h"

#include <array>
#include <bit>
#include <numeric>
#include <span>

#include "base/parallel.h"

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

struct DepthKey {
  std::uint32_t depth;  ///< A float's bits: depths are above 0, and in the order of their values.
  std::uint32_t index;
};

/// By depth, equal ones as they are: digit by digit, the last first. With it `in_order` takes 0.55
/// to 0.6 of the time with std::sort (a quarter of a million to four million splats).
void sort(std::vector<DepthKey>& keys) {
  constexpr int digit = 11;
  std::vector<DepthKey> other(keys.size());
  for (int shift = 0; shift < 32; shift += digit) {
    const auto digit_of = [&](const DepthKey& key) {
      return key.depth >> shift & ((1u << digit) - 1);
    };
    std::array<std::uint32_t, 1 << digit> place{};
    for (const DepthKey& key : keys) ++place[digit_of(key)];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), 0u);
    for (const DepthKey& key : keys) other[place[digit_of(key)]++] = key;
    keys.swap(other);
  }
}

}  // namespace

Values<DefraySplat> in_order(const Values<DefraySplat>& splats) {
  const std::span<const DefraySplat> all = splats.host();
  std::vector<DepthKey> keys;
  keys.reserve(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (has_pixels(all[i])) keys.push_back({std::bit_cast<std::uint32_t>(all[i].z_near), i});
  }
  sort(keys);
  auto sorted = Values<DefraySplat>::room(keys.size());
  const std::span<DefraySplat> to = sorted.edit();
  parallel_for_each(keys.size(), [&](std::size_t i) { to[i] = all[keys[i].index]; });
  return sorted;
}

std::vector<std::uint32_t> splats_a_tile(const Values<DefraySplat>& splats, int tiles_x,
                                         int tiles_y) {
  std::vector<std::uint32_t> counts(size(tiles_x) * size(tiles_y));
  for (const DefraySplat& s : splats) {
    for_each_tile(s, tiles_x, [&](std::uint32_t tile) { ++counts[tile]; });
  }
  return counts;
}

SplatTiles next_tiles(const Values<DefraySplat>& splats, const std::vector<std::uint32_t>& counts,
                      int tiles_x, std::uint32_t first_tile, std::size_t most) {
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
  const std::span<const DefraySplat> all = splats.host();
  for (std::uint32_t i = 0; i < splats.size(); ++i) {
    for_each_tile(all[i], tiles_x, [&](std::uint32_t tile) {
      const std::uint32_t t = tile - first_tile;  // wraps round below the first
      if (t < tiles.tile_count) tiles.list[next[t]++] = i;
    });
  }
  return tiles;
}

}  // namespace defray
