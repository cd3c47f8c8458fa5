#include "scenes/block_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scenes/block_textures.h"
#include "scenes/texture.h"

namespace defray {
namespace {

using Triple = std::array<double, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A ray's way from block to block: Amanatides & Woo 1987. Coordinates are in blocks.
class Walk {
 public:
  /// Starts where the ray enters the world, or where it begins within.
  Walk(const BlockWorld& world, const Triple& origin, const Triple& direction) {
    const std::array<int, 3> size{world.size(), world.height(), world.size()};
    for (std::size_t a = 0; a < 3; ++a) {
      const double inverse = 1 / direction[a];
      step_[a] = direction[a] < 0 ? -1 : 1;
      const double near = direction[a] < 0 ? size[a] : 0, far = direction[a] < 0 ? 0 : size[a];
      if (direction[a] == 0) {
        if (origin[a] < 0 || origin[a] >= size[a]) leave_ = -infinity;
        continue;
      }
      if ((near - origin[a]) * inverse > t_) {
        t_ = (near - origin[a]) * inverse;
        axis_ = a;
      }
      leave_ = std::min(leave_, (far - origin[a]) * inverse);
    }
    for (std::size_t a = 0; a < 3; ++a) {
      cell_[a] =
          std::clamp(static_cast<int>(std::floor(origin[a] + t_ * direction[a])), 0, size[a] - 1);
      end_[a] = step_[a] < 0 ? -1 : size[a];
      const bool moves = direction[a] != 0;
      period_[a] = moves ? std::fabs(1 / direction[a]) : infinity;
      next_[a] = moves ? (cell_[a] + (step_[a] > 0) - origin[a]) / direction[a] : infinity;
    }
  }

  bool is_inside() const { return t_ < leave_ && cell_[axis_] != end_[axis_]; }
  /// True in the block in which the ray begins.
  bool is_at_origin() const { return t_ == 0; }
  const std::array<int, 3>& cell() const { return cell_; }
  double t() const { return t_; }                  ///< Where the ray enters the block.
  std::size_t axis() const { return axis_; }       ///< Across which face: 0, 1, 2.
  double facing() const { return -step_[axis_]; }  ///< That face's normal along the axis.

  void advance() {
    axis_ = next_[0] < next_[1] ? (next_[0] < next_[2] ? 0 : 2) : (next_[1] < next_[2] ? 1 : 2);
    t_ = next_[axis_];
    next_[axis_] += period_[axis_];
    cell_[axis_] += step_[axis_];
  }

 private:
  double t_ = 0, leave_ = infinity;
  std::size_t axis_ = 0;
  std::array<int, 3> cell_{}, step_{}, end_{};
  Triple period_{}, next_{};
};

double fraction(double value) {
  return std::min(value - std::floor(value), std::nextafter(1.0, 0.0));
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
  Walk walk(world_, {o.x, o.y, o.z}, {d.x, d.y, d.z});
  bool was_solid = walk.is_at_origin();
  for (; walk.is_inside() && walk.t() < hit.t; walk.advance()) {
    const auto [x, y, z] = walk.cell();
    const Block block = world_.at(x, y, z);
    if (block != Block::air && !was_solid && walk.t() > ray.from) {
      Triple normal{};
      normal[walk.axis()] = walk.facing();
      hit = {walk.t(), colour_at(block, walk, o + d * walk.t()),
             view_.to_camera({normal[0], normal[1], normal[2]})};
      return true;
    }
    was_solid = block != Block::air;
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
