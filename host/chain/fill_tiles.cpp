#include "chain/fill_tiles.h"

#include <algorithm>

#include "lens/coc.h"

namespace defray {
namespace {

constexpr int side = DEFRAY_FILL_TILE;

struct Tile {
  std::int32_t nearest = DEFRAY_TAME_QUANTA, farthest = -DEFRAY_TAME_QUANTA;
  bool has_mixed = false;

  void add(const Tile& other) {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
    has_mixed |= other.has_mixed;
  }
};

class Tiles {
 public:
  Tiles(const Frame& f, const Words& mixed)
      : across_((f.width + side - 1) / side),
        down_((f.height + side - 1) / side),
        tiles_(size(across_) * size(down_)) {
    const auto coc_quanta = f.coc_quanta.host();
    const auto is_mixed = mixed.host();
    for (std::size_t i = 0; i < coc_quanta.size(); ++i) {
      const std::int32_t coc = tame(coc_quanta[i]);
      const std::size_t row = i / size(f.width) / side;
      tiles_[row * size(across_) + i % size(f.width) / side].add({coc, coc, is_mixed[i] != 0});
    }
  }

  std::size_t count() const { return tiles_.size(); }

  /// All tiles within so many of one.
  Tile around(std::size_t tile, int reach) const {
    const int x = static_cast<int>(tile) % across_, y = static_cast<int>(tile) / across_;
    Tile all;
    for (int j = std::max(0, y - reach); j <= std::min(down_ - 1, y + reach); ++j) {
      for (int i = std::max(0, x - reach); i <= std::min(across_ - 1, x + reach); ++i) {
        all.add(tiles_[size(j) * size(across_) + size(i)]);
      }
    }
    return all;
  }

 private:
  int across_, down_;
  std::vector<Tile> tiles_;
};

}  // namespace

int fill_reach(std::int32_t farthest, std::int32_t own) { return (farthest - own) / 256 + 2; }

Quanta farthest_to_fill(const Frame& f, const Words& mixed) {
  const Tiles tiles(f, mixed);
  const Tile all = tiles.around(0, std::max(f.width, f.height));
  std::vector<std::int32_t> farthest;
  for (std::size_t t = 0; t < tiles.count(); ++t) {
    // A mixed pixel looks from the nearest surface around it, which may be the next tile's.
    const std::int32_t nearest = tiles.around(t, 1).nearest;
    Tile met = all;
    // The less far there is to meet, the less far a pixel looks.
    for (int i = 0; i < 2; ++i) met = tiles.around(t, fill_reach(met.farthest, nearest) / side + 1);
    farthest.push_back(met.has_mixed ? met.farthest : DEFRAY_NOTHING_BEHIND);
  }
  return farthest;
}

}  // namespace defray
