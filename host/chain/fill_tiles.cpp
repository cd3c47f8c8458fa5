#include "chain/fill_tiles.h"

#include <algorithm>

#include "lens/coc.h"

namespace defray {

int fill_reach(std::int32_t farthest, std::int32_t own) { return (farthest - own) / 256 + 2; }

Words tiles_to_fill(const Frame& f, const Words& mixed) {
  constexpr int side = DEFRAY_FILL_TILE;
  const int across = (f.width + side - 1) / side, down = (f.height + side - 1) / side;
  std::vector<std::int32_t> nearest(size(across) * size(down), DEFRAY_TAME_QUANTA);
  std::vector<std::uint32_t> has_mixed(nearest.size()), active(nearest.size());
  std::int32_t farthest = -DEFRAY_TAME_QUANTA;
  const auto coc_quanta = f.coc_quanta.host();
  const auto is_mixed = mixed.host();
  for (std::size_t i = 0; i < coc_quanta.size(); ++i) {
    const std::size_t tile = i / size(f.width) / side * size(across) + i % size(f.width) / side;
    const std::int32_t coc = tame(coc_quanta[i]);
    nearest[tile] = std::min(nearest[tile], coc);
    farthest = std::max(farthest, coc);
    has_mixed[tile] |= is_mixed[i];
  }
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const std::size_t tile = size(y) * size(across) + size(x);
      const int reach = fill_reach(farthest, nearest[tile]) / side + 1;
      for (int j = std::max(0, y - reach); j <= std::min(down - 1, y + reach); ++j) {
        const auto row = has_mixed.begin() + static_cast<std::ptrdiff_t>(size(j) * size(across));
        const auto first = row + std::max(0, x - reach);
        const auto last = row + std::min(across - 1, x + reach) + 1;
        if (std::find(first, last, 1u) != last) active[tile] = 1;
      }
    }
  }
  return active;
}

}  // namespace defray
