#include "chain/fill_tiles.h"

#include <algorithm>

#include "chain/tiles.h"
#include "lens/coc.h"

namespace defray {
namespace {

struct FillTile {
  std::int32_t nearest = DEFRAY_TAME_QUANTA, farthest = -DEFRAY_TAME_QUANTA;
  bool has_mixed = false;

  void add(const FillTile& other) {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
    has_mixed |= other.has_mixed;
  }
};

}  // namespace

int fill_reach(std::int32_t farthest, std::int32_t own) { return (farthest - own) / 256 + 2; }

Quanta farthest_to_fill(const Frame& f, const Words& mixed) {
  const auto coc_quanta = f.coc_quanta.host();
  const auto is_mixed = mixed.host();
  const auto look = [&](FillTile& tile, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::size_t i = f.index(x, y);
        const std::int32_t coc = tame(coc_quanta[i]);
        tile.add({coc, coc, is_mixed[i] != 0});
      }
    }
  };
  constexpr int side = DEFRAY_FILL_TILE;
  const Tiles<FillTile> tiles(f.width, f.height, side, look);
  const FillTile all = tiles.all();
  std::vector<std::int32_t> farthest;
  for (std::size_t t = 0; t < tiles.count(); ++t) {
    // A mixed pixel looks from the nearest surface around it, which may be the next tile's.
    const std::int32_t nearest = tiles.around(t, 1).nearest;
    FillTile met = all;
    // The less far there is to meet, the less far a pixel looks.
    for (int i = 0; i < 2; ++i) met = tiles.around(t, fill_reach(met.farthest, nearest) / side + 1);
    farthest.push_back(met.has_mixed ? met.farthest : DEFRAY_NOTHING_BEHIND);
  }
  return farthest;
}

}  // namespace defray
