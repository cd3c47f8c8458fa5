// Twins of kernels/gather_reach.cl, each tile against each.
#include <algorithm>
#include <cstdlib>

#include "reference/reference.h"

namespace defray::reference {
namespace {

constexpr int tile = DEFRAY_GATHER_TILE;

int tiles_across(int pixels) { return (pixels + tile - 1) / tile; }

std::size_t as_size(int i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<std::int32_t> gather_tiles(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta) {
  const int across = tiles_across(width);
  std::vector<std::int32_t> largest(as_size(across) * as_size(tiles_across(height)));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::int32_t& most = largest[as_size(y / tile) * as_size(across) + as_size(x / tile)];
      most = std::max(most, std::abs(coc_quanta[as_size(y) * as_size(width) + as_size(x)]));
    }
  }
  return largest;
}

std::vector<std::int32_t> gather_reach(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta) {
  const int across = tiles_across(width);
  const std::vector<std::int32_t> largest = gather_tiles(width, height, coc_quanta);
  std::vector<std::int32_t> reach(largest.size());
  for (std::size_t i = 0; i < reach.size(); ++i) {
    const int x = static_cast<int>(i) % across, y = static_cast<int>(i) / across;
    for (std::size_t j = 0; j < reach.size(); ++j) {
      const int their_x = static_cast<int>(j) % across, their_y = static_cast<int>(j) / across;
      const int steps = std::max(std::abs(x - their_x), std::abs(y - their_y));
      const double gap_px = std::max(steps - 1, 0) * tile;
      if (gap_px <= largest[j] / 256.0) reach[i] = std::max(reach[i], largest[j]);
    }
  }
  return reach;
}

}  // namespace defray::reference
