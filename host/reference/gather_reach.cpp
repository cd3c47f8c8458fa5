// Twins of kernels/methods/gather_reach.cl, each tile against each.
#include <algorithm>
#include <cstdlib>

#include "reference/reference.h"

namespace defray::reference {
namespace {

constexpr int tile_px = DEFRAY_GATHER_TILE;

int tiles_across(int pixels) { return (pixels + tile_px - 1) / tile_px; }

}  // namespace

std::vector<std::int32_t> gather_tiles(const Frame& f) {
  const int width = f.width, height = f.height;
  const auto coc_quanta = f.coc_quanta.host();
  const int across = tiles_across(width);
  std::vector<std::int32_t> largest(size(across) * size(tiles_across(height)));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::int32_t& most = largest[size(y / tile_px) * size(across) + size(x / tile_px)];
      most = std::max(most, std::abs(coc_quanta[size(y) * size(width) + size(x)]));
    }
  }
  return largest;
}

std::vector<std::int32_t> gather_reach(const Frame& f) {
  const int across = tiles_across(f.width);
  const std::vector<std::int32_t> largest = gather_tiles(f);
  std::vector<std::int32_t> reach(largest.size());
  for (std::size_t i = 0; i < reach.size(); ++i) {
    const int x = static_cast<int>(i) % across, y = static_cast<int>(i) / across;
    for (std::size_t j = 0; j < reach.size(); ++j) {
      const int their_x = static_cast<int>(j) % across, their_y = static_cast<int>(j) / across;
      const int steps = std::max(std::abs(x - their_x), std::abs(y - their_y));
      const double gap_px = std::max(steps - 1, 0) * tile_px;
      if (gap_px <= largest[j] / 256.0) reach[i] = std::max(reach[i], largest[j]);
    }
  }
  return reach;
}

}  // namespace defray::reference
