// Twin of kernels/gather_reach.cl, each tile against each.
#include <algorithm>
#include <cstdlib>

#include "reference/reference.h"

namespace defray::reference {

std::vector<std::int32_t> gather_reach(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta) {
  constexpr int tile = DEFRAY_GATHER_TILE;
  const int across = (width + tile - 1) / tile, down = (height + tile - 1) / tile;
  const auto as_size = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<std::int32_t> largest(as_size(across) * as_size(down)), reach(largest.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::int32_t& most = largest[as_size(y / tile) * as_size(across) + as_size(x / tile)];
      most = std::max(most, std::abs(coc_quanta[as_size(y) * as_size(width) + as_size(x)]));
    }
  }
  for (int i = 0; i < across * down; ++i) {
    for (int j = 0; j < across * down; ++j) {
      const int steps =
          std::max(std::abs(i % across - j % across), std::abs(i / across - j / across));
      const double gap_px = std::max(steps - 1, 0) * tile;
      if (gap_px <= largest[as_size(j)] / 256.0) {
        reach[as_size(i)] = std::max(reach[as_size(i)], largest[as_size(j)]);
      }
    }
  }
  return reach;
}

}  // namespace defray::reference
