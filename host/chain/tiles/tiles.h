#pragma once
// What is known of a frame's square tiles: each tile's `Tile`, which others add themselves to.
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/plane.h"
#include "frame/band_rows.h"

namespace defray {

template <typename Tile>
class Tiles {
 public:
  /// look(tile, x0, y0, x1, y1) fills in the tile of these pixels, of `rows`; of others nothing is
  /// known.
  template <typename Look>
  Tiles(int width, int height, Rows rows, int side, const Look& look)
      : across_((width + side - 1) / side),
        down_((height + side - 1) / side),
        tiles_(size(across_) * size(down_)) {
    const int first = rows.y / side, end = (rows.end + side - 1) / side;
    parallel_for(end - first, [&](int row) {
      const int j = first + row;
      for (int i = 0; i < across_; ++i) {
        look(tiles_[size(j) * size(across_) + size(i)], i * side, std::max(rows.y, j * side),
             std::min(width, (i + 1) * side), std::min(rows.end, (j + 1) * side));
      }
    });
  }

  /// The first of a row of tiles, and one past the last of those of `rows`.
  std::size_t first_of(Rows rows, int side) const { return size(rows.y / side) * size(across_); }
  std::size_t end_of(Rows rows, int side) const {
    return size((rows.end + side - 1) / side) * size(across_);
  }

  std::size_t count() const { return tiles_.size(); }
  const Tile& operator[](std::size_t tile) const { return tiles_[tile]; }

  Tile all() const { return around(0, std::max(across_, down_)); }

  /// All tiles within so many of one.
  Tile around(std::size_t tile, int reach) const {
    const int x = static_cast<int>(tile) % across_, y = static_cast<int>(tile) / across_;
    Tile sum;
    for (int j = std::max(0, y - reach); j <= std::min(down_ - 1, y + reach); ++j) {
      for (int i = std::max(0, x - reach); i <= std::min(across_ - 1, x + reach); ++i) {
        sum.add(tiles_[size(j) * size(across_) + size(i)]);
      }
    }
    return sum;
  }

 private:
  int across_, down_;
  std::vector<Tile> tiles_;
};

}  // namespace defray
