#include "scenes/builtin/block_textures.h"

#include <array>

#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr int texels = 16;
using Tile = std::array<Vec3, texels * texels>;

struct Look {
  Vec3 dark, light;
};

Look look_of(Block block) {
  switch (block) {
    case Block::grass:
      return {{0.10, 0.22, 0.035}, {0.2, 0.37, 0.07}};
    case Block::sand:
      return {{0.56, 0.48, 0.28}, {0.7, 0.62, 0.4}};
    case Block::snow:
      return {{0.8, 0.83, 0.88}, {0.92, 0.94, 0.96}};
    case Block::leaves:
      return {{0.04, 0.13, 0.02}, {0.15, 0.31, 0.05}};
    case Block::needles:
      return {{0.02, 0.08, 0.035}, {0.07, 0.19, 0.08}};
    case Block::wood:
      return {{0.11, 0.065, 0.03}, {0.24, 0.15, 0.075}};
    case Block::water:
      return {{0.035, 0.13, 0.26}, {0.055, 0.18, 0.33}};
    default:
      return {{0.17, 0.1, 0.05}, {0.3, 0.19, 0.1}};  // dirt
  }
}

/// Bark runs along the trunk, waves along the water; the rest is grain.
double grain(Block block, int i, int j) {
  const auto kind = static_cast<std::int64_t>(block);
  if (block == Block::wood) return 0.7 * hash01(i, kind) + 0.3 * hash01(i, j, kind);
  if (block == Block::water) return 0.7 * hash01(j, kind) + 0.3 * hash01(i / 4, j, kind);
  return hash01(i, j, kind);
}

Tile make_tile(Block block) {
  const Look look = look_of(block);
  Tile tile;
  for (int j = 0; j < texels; ++j) {
    for (int i = 0; i < texels; ++i) {
      tile[static_cast<std::size_t>(j * texels + i)] =
          mix(look.dark, look.light, grain(block, i, j));
    }
  }
  return tile;
}

using Tiles = std::array<Tile, static_cast<std::size_t>(Block::water) + 1>;

const Tiles& tiles() {
  static const Tiles all = [] {
    Tiles made;
    for (std::size_t b = 0; b < made.size(); ++b) made[b] = make_tile(static_cast<Block>(b));
    return made;
  }();
  return all;
}

}  // namespace

Vec3 block_colour(Block block, bool is_side, double u, double v, double variant) {
  const int i = static_cast<int>(u * texels), j = static_cast<int>(v * texels);
  // Grass and snow hang over the upper edge of their side; the rest of it is earth.
  const bool is_turf = block == Block::grass || block == Block::snow;
  if (is_turf && is_side && j > 7 + static_cast<int>(4 * hash01(i, 77))) block = Block::dirt;
  return tiles()[static_cast<std::size_t>(block)][static_cast<std::size_t>(j * texels + i)] *
         (0.9 + 0.2 * variant);
}

}  // namespace defray
