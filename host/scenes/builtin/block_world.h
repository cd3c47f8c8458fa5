#pragma once
// The block world of Glatzel & Wilhelm: terrain by the diamond-square algorithm, made of blocks
// half a metre wide, with lakes, snow on the heights, and trees up to six metres.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace defray {

enum class Block : std::uint8_t { air, grass, dirt, sand, snow, leaves, needles, wood, water };

/// Side of a block, metres.
constexpr double block_size = 0.5;

/// size x height x size blocks: size a multiple of tile_size, height at most 255. y is up, and 0
/// the lowest layer.
class BlockWorld {
 public:
  BlockWorld(int size, int height);
  int size() const { return size_; }
  int height() const { return height_; }
  Block at(int x, int y, int z) const { return blocks_[index(x, y, z)]; }
  void set(int x, int y, int z, Block block);
  bool contains(int x, int y, int z) const;
  /// The lowest layer from which on the tile_size x tile_size columns around (x, z) are all air.
  int tile_top(int x, int z) const { return tile_tops_[tile(x, z)]; }
  static constexpr int tile_size = 8;

 private:
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(height_) +
           static_cast<std::size_t>(y);
  }
  std::size_t tile(int x, int z) const {
    return static_cast<std::size_t>(z / tile_size) * static_cast<std::size_t>(size_ / tile_size) +
           static_cast<std::size_t>(x / tile_size);
  }
  int size_, height_;
  std::vector<Block> blocks_;
  std::vector<std::uint8_t> tile_tops_;
};

/// Heights in [0, 1] on a (2^levels + 1)^2 grid, row by row: diamond-square (Fournier, Fussell &
/// Carpenter 1982), the displacement halving with each level.
std::vector<double> diamond_square(int levels, int seed);

/// A world 2^levels blocks wide; the same for the same seed.
BlockWorld make_block_world(int levels, int seed);

}  // namespace defray
