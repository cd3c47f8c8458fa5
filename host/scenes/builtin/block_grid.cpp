#include "scenes/builtin/block_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenes/builtin/block_textures.h"
#include "scenes/geometry/texture.h"

namespace defray {
namespace {

using Triple = std::array<double, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct BlockBox {
  std::array<int, 3> low, high;  ///< From low to below high.
};

/// A ray's way from block to block: Amanatides & Woo 1987. Coordinates are in blocks.
class Walk {
 public:
  /// Starts where the ray enters the world, or where it begins within.
  Walk(const BlockBox& world, const Triple& origin, const Triple& direction)
      : world_(world), origin_(origin), direction_(direction) {
    double leave = infinity;
    for (std::size_t a = 0; a < 3; ++a) {
      // A ray along a face never crosses it; 0 x infinity would be NaN.
      inverse_[a] = 1 / (direction[a] == 0 ? 1e-300 : direction[a]);
      const double near = (inverse_[a] < 0 ? world.high[a] : world.low[a]) - origin[a];
      const double far = (inverse_[a] < 0 ? world.low[a] : world.high[a]) - origin[a];
      if (near * inverse_[a] > t_) {
        t_ = near * inverse_[a];
        axis_ = a;
      }
      leave = std::min(leave, far * inverse_[a]);
    }
    is_inside_ = t_ < leave;
    enter(world);
  }

  bool is_inside() const { return is_inside_; }
  /// True in the block in which the ray begins.
  bool is_at_origin() const { return t_ == 0; }
  const std::array<int, 3>& cell() const { return cell_; }
  double t() const { return t_; }             ///< Where the ray enters the block.
  std::size_t axis() const { return axis_; }  ///< Across which face: 0, 1, 2.
  double facing() const { return inverse_[axis_] < 0 ? 1 : -1; }  ///< Its normal along the axis.

  /// Into the next block.
  void advance() {
    axis_ = next_[0] < next_[1] ? (next_[0] < next_[2] ? 0 : 2) : (next_[1] < next_[2] ? 1 : 2);
    t_ = next_[axis_];
    cell_[axis_] += inverse_[axis_] < 0 ? -1 : 1;
    next_[axis_] = exit(axis_, cell_[axis_], cell_[axis_] + 1);
    check_inside();
  }

  /// Out of a box that the ray is in: into the first block behind it.
  void leave(const BlockBox& box) {
    const auto out = [&](std::size_t a) { return exit(a, box.low[a], box.high[a]); };
    axis_ = out(0) < out(1) ? (out(0) < out(2) ? 0 : 2) : (out(1) < out(2) ? 1 : 2);
    t_ = out(axis_);
    enter(box);
    cell_[axis_] = inverse_[axis_] < 0 ? box.low[axis_] - 1 : box.high[axis_];
    next_[axis_] = exit(axis_, cell_[axis_], cell_[axis_] + 1);
    check_inside();
  }

 private:
  double exit(std::size_t a, int low, int high) const {
    return ((inverse_[a] < 0 ? low : high) - origin_[a]) * inverse_[a];
  }

  /// Takes the block at t_, which lies in `box` or on its face.
  void enter(const BlockBox& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double at = std::floor(origin_[a] + t_ * direction_[a]);
      cell_[a] = static_cast<int>(
          std::clamp(at, static_cast<double>(box.low[a]), static_cast<double>(box.high[a] - 1)));
      next_[a] = exit(a, cell_[a], cell_[a] + 1);
    }
  }

  void check_inside() {
    is_inside_ = cell_[axis_] >= world_.low[axis_] && cell_[axis_] < world_.high[axis_];
  }

  BlockBox world_;
  Triple origin_, direction_, inverse_{}, next_{};
  double t_ = 0;
  std::size_t axis_ = 0;
  std::array<int, 3> cell_{};
  bool is_inside_ = false;
};

double fraction(double value) {
  return std::min(value - std::floor(value), std::nextafter(1.0, 0.0));
}

/// Most of a ray's way leads through air high above the ground: it takes this in one step.
BlockBox air_over_tile(const BlockWorld& world, int x, int z) {
  constexpr int side = BlockWorld::tile_size;
  const int x0 = x / side * side, z0 = z / side * side;
  return {{x0, world.tile_top(x, z), z0}, {x0 + side, world.height(), z0 + side}};
}

Vec3 normal_of(const Walk& walk) {
  Triple normal{};
  normal[walk.axis()] = walk.facing();
  return {normal[0], normal[1], normal[2]};
}

Vec3 colour_at(Block block, const Walk& walk, const Vec3& p) {
  const auto [x, y, z] = walk.cell();
  const double variant = hash01(x, y, z);
  if (walk.axis() == 1) return block_colour(block, false, fraction(p.x), fraction(p.z), variant);
  const double along = walk.axis() == 0 ? p.z : p.x;
  return block_colour(block, true, fraction(along), fraction(-p.y), variant);
}

}  // namespace

Viewpoint Viewpoint::looking(const Vec3& position, double yaw, double pitch) {
  const Vec3 right{std::cos(yaw), 0, -std::sin(yaw)};
  const Vec3 ahead{std::sin(yaw), 0, std::cos(yaw)}, up{0, 1, 0};
  const Vec3 forward = ahead * std::cos(pitch) - up * std::sin(pitch);
  const Vec3 down = ahead * -std::sin(pitch) - up * std::cos(pitch);
  return {position, right, down, forward};
}

Vec3 Viewpoint::to_camera(const Vec3& direction) const {
  return {dot(direction, right), dot(direction, down), dot(direction, forward)};
}

Vec3 BlockGrid::to_world(const Vec3& d) const {
  return view_.right * d.x + view_.down * d.y + view_.forward * d.z;
}

bool BlockGrid::intersect(const Ray& ray, Hit& hit) const {
  const Vec3 o = (view_.position + to_world(ray.origin)) / block_size;
  const Vec3 d = to_world(ray.direction) / block_size;
  Walk walk({{0, 0, 0}, {world_.size(), world_.height(), world_.size()}}, {o.x, o.y, o.z},
            {d.x, d.y, d.z});
  bool was_solid = walk.is_at_origin();
  while (walk.is_inside() && walk.t() < hit.t) {
    const auto [x, y, z] = walk.cell();
    if (y >= world_.tile_top(x, z)) {
      was_solid = false;
      walk.leave(air_over_tile(world_, x, z));
      continue;
    }
    const Block block = world_.at(x, y, z);
    if (block != Block::air && !was_solid && walk.t() > ray.from) {
      hit = {walk.t(), colour_at(block, walk, o + d * walk.t()), view_.to_camera(normal_of(walk))};
      return true;
    }
    was_solid = block != Block::air;
    walk.advance();
  }
  return false;
}

Bounds BlockGrid::bounds() const {
  const double side = world_.size() * block_size, top = world_.height() * block_size;
  const Vec3 middle = view_.to_camera(Vec3{side / 2, top / 2, side / 2} - view_.position);
  const double radius = length({side / 2, top / 2, side / 2});
  const Vec3 reach{radius, radius, radius};
  return {middle - reach, middle + reach};
}

}  // namespace defray
