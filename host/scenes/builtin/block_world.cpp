#include "scenes/builtin/block_world.h"

#include <algorithm>
#include <cmath>

#include "scenes/geometry/texture.h"

namespace defray {
namespace {

constexpr int world_height = 72, water_level = 8, snow_level = 34, tallest_tree = 12;

/// The square grid of diamond_square while it is being made.
class Heights {
 public:
  Heights(int levels, int seed) : size_(1 << levels), seed_(seed) {
    values_.resize(static_cast<std::size_t>(size_ + 1) * static_cast<std::size_t>(size_ + 1));
  }
  double& at(int x, int z) {
    return values_[static_cast<std::size_t>(z) * static_cast<std::size_t>(size_ + 1) +
                   static_cast<std::size_t>(x)];
  }
  /// Sets a point to the mean of its four neighbours at these offsets, displaced.
  void displace(int x, int z, const int (&offsets)[4][2], double amount) {
    double sum = 0;
    int count = 0;
    for (const auto& [dx, dz] : offsets) {
      if (x + dx < 0 || x + dx > size_ || z + dz < 0 || z + dz > size_) continue;
      sum += at(x + dx, z + dz);
      ++count;
    }
    at(x, z) = sum / count + amount * (hash01(x, z, seed_) - 0.5);
  }
  std::vector<double>& values() { return values_; }

 private:
  int size_, seed_;
  std::vector<double> values_;
};

void normalize(std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double from = *low, range = std::max(*high - *low, 1e-12);
  for (double& value : values) value = (value - from) / range;
}

Block surface_block(int x, int z, int ground) {
  if (ground <= water_level + 1) return Block::sand;
  const double ragged = 6 * value_noise(x / 9.0, z / 9.0, 11);
  if (ground + ragged > snow_level) return Block::snow;
  return Block::grass;
}

void fill_column(BlockWorld& world, int x, int z, int ground) {
  for (int y = 0; y < ground - 1; ++y) world.set(x, y, z, Block::dirt);
  world.set(x, ground - 1, z, surface_block(x, z, ground));
  for (int y = ground; y < water_level; ++y) world.set(x, y, z, Block::water);
}

void set_in_air(BlockWorld& world, int x, int y, int z, Block block) {
  if (world.contains(x, y, z) && world.at(x, y, z) == Block::air) world.set(x, y, z, block);
}

/// Half the width of a crown `below` blocks under its top: a ball of leaves or a cone of needles.
double crown_radius(bool is_conifer, int below) {
  if (is_conifer) return 0.6 + 0.32 * below + (below & 1 ? 0.5 : 0);
  const double from_middle = below - 2.5;
  return std::sqrt(std::max(0.0, 11.5 - from_middle * from_middle));
}

void plant_tree(BlockWorld& world, int x, int ground, int z, bool is_conifer) {
  const int tall = tallest_tree - static_cast<int>((is_conifer ? 3 : 5) * hash01(x, z, 4));
  const int crown = is_conifer ? tall - 2 : 6;
  for (int below = 0; below < crown; ++below) {
    const double radius = crown_radius(is_conifer, below);
    const int reach = static_cast<int>(radius), y = ground + tall - 1 - below;
    for (int dz = -reach; dz <= reach; ++dz) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const double ragged = 1.2 * hash01(x + dx, y, z + dz);
        if (dx * dx + dz * dz > radius * radius - ragged) continue;
        set_in_air(world, x + dx, y, z + dz, is_conifer ? Block::needles : Block::leaves);
      }
    }
  }
  for (int y = ground; y < ground + tall - 2; ++y) world.set(x, y, z, Block::wood);
}

/// The share of places for a tree that bear one: woods and meadows.
double tree_density(int x, int z) {
  const double wood =
      value_noise(x / 70.0, z / 70.0, 21) * 0.7 + value_noise(x / 23.0, z / 23.0, 22) * 0.3;
  return std::clamp(4 * (wood - 0.38), 0.01, 0.85);
}

void plant_trees(BlockWorld& world, const std::vector<int>& ground) {
  constexpr int spacing = 5;
  for (int cell_z = 0; cell_z < world.size() / spacing; ++cell_z) {
    for (int cell_x = 0; cell_x < world.size() / spacing; ++cell_x) {
      const int x = cell_x * spacing + static_cast<int>(spacing * hash01(cell_x, cell_z, 1));
      const int z = cell_z * spacing + static_cast<int>(spacing * hash01(cell_x, cell_z, 2));
      const int at = ground[static_cast<std::size_t>(z * world.size() + x)];
      if (surface_block(x, z, at) == Block::sand) continue;
      if (hash01(cell_x, cell_z, 3) > tree_density(x, z)) continue;
      plant_tree(world, x, at, z, at + 8 * hash01(x, z, 5) > 27);
    }
  }
}

}  // namespace

BlockWorld::BlockWorld(int size, int height)
    : size_(size),
      height_(height),
      blocks_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
              static_cast<std::size_t>(height)),
      tile_tops_(static_cast<std::size_t>(size / tile_size) *
                 static_cast<std::size_t>(size / tile_size)) {}

void BlockWorld::set(int x, int y, int z, Block block) {
  blocks_[index(x, y, z)] = block;
  std::uint8_t& top = tile_tops_[tile(x, z)];
  top = std::max(top, static_cast<std::uint8_t>(y + 1));
}

bool BlockWorld::contains(int x, int y, int z) const {
  return x >= 0 && y >= 0 && z >= 0 && x < size_ && y < height_ && z < size_;
}

std::vector<double> diamond_square(int levels, int seed) {
  Heights heights(levels, seed);
  const int size = 1 << levels;
  for (const int z : {0, size}) {
    for (const int x : {0, size}) heights.at(x, z) = hash01(x, z, seed);
  }
  double amount = 1;
  for (int step = size; step > 1; step /= 2, amount /= 2) {
    const int h = step / 2;
    for (int z = h; z < size; z += step) {
      for (int x = h; x < size; x += step) {
        heights.displace(x, z, {{-h, -h}, {h, -h}, {-h, h}, {h, h}}, amount);
      }
    }
    for (int z = 0; z <= size; z += h) {
      for (int x = z / h % 2 ? 0 : h; x <= size; x += step) {
        heights.displace(x, z, {{-h, 0}, {h, 0}, {0, -h}, {0, h}}, amount);
      }
    }
  }
  normalize(heights.values());
  return heights.values();
}

BlockWorld make_block_world(int levels, int seed) {
  const std::vector<double> heights = diamond_square(levels, seed);
  BlockWorld world(1 << levels, world_height);
  std::vector<int> ground;
  for (int z = 0; z < world.size(); ++z) {
    for (int x = 0; x < world.size(); ++x) {
      const double h = heights[static_cast<std::size_t>(z * (world.size() + 1) + x)];
      const double rise = (world_height - tallest_tree - 2) * std::pow(h, 1.6);
      ground.push_back(1 + static_cast<int>(rise));
      fill_column(world, x, z, ground.back());
    }
  }
  plant_trees(world, ground);
  return world;
}

}  // namespace defray
