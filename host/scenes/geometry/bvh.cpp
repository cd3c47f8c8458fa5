#include "scenes/geometry/bvh.h"

#include <algorithm>
#include <array>

namespace defray {
namespace {

constexpr std::size_t leaf_size = 2;
constexpr std::size_t stack_size = 64;  // levels; median splits need log2 of the count

using Axis = double Vec3::*;
constexpr std::array<Axis, 3> axes{&Vec3::x, &Vec3::y, &Vec3::z};

Bounds merged(Bounds a, const Bounds& b) {
  for (const Axis axis : axes) {
    a.low.*axis = std::min(a.low.*axis, b.low.*axis);
    a.high.*axis = std::max(a.high.*axis, b.high.*axis);
  }
  return a;
}

double middle(const Bounds& b, Axis axis) { return b.low.*axis + b.high.*axis; }

Axis longest(const Bounds& b) {
  const Vec3 size = b.high - b.low;
  return *std::max_element(axes.begin(), axes.end(),
                           [&](Axis i, Axis j) { return size.*i < size.*j; });
}

/// True where the ray passes through the box between ray.from and `limit`. A ray that runs along a
/// face may miss, as it misses what is inside.
bool meets(const Bounds& b, const Ray& ray, const Vec3& inverse, double limit) {
  double enter = ray.from, leave = limit;
  for (const Axis axis : axes) {
    const double to_low = (b.low.*axis - ray.origin.*axis) * inverse.*axis;
    const double to_high = (b.high.*axis - ray.origin.*axis) * inverse.*axis;
    enter = std::max(enter, std::min(to_low, to_high));
    leave = std::min(leave, std::max(to_low, to_high));
  }
  // Boxes of flat primitives are flat: rounding must not make the ray leave before it enters.
  constexpr double slack = 1e-9;
  return enter <= leave * (1 + slack) + slack;
}

}  // namespace

Bvh::Bvh(const std::vector<std::unique_ptr<Primitive>>& primitives) {
  std::vector<Item> items;
  for (const auto& primitive : primitives) {
    items.push_back({primitive.get(), primitive->bounds()});
  }
  if (!items.empty()) build(items, 0, items.size());
  for (const Item& item : items) order_.push_back(item.primitive);
}

void Bvh::build(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  const std::size_t at = nodes_.size();
  Bounds bounds = items[begin].bounds;
  for (std::size_t i = begin; i < end; ++i) bounds = merged(bounds, items[i].bounds);
  nodes_.push_back({bounds, begin, end - begin, longest(bounds)});
  if (end - begin <= leaf_size) return;
  const Axis axis = nodes_[at].split;
  const std::size_t half = begin + (end - begin) / 2;
  const auto item = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(item(begin), item(half), item(end), [&](const Item& a, const Item& b) {
    return middle(a.bounds, axis) < middle(b.bounds, axis);
  });
  build(items, begin, half);
  nodes_[at].count = 0;
  nodes_[at].first = nodes_.size();
  build(items, half, end);
}

bool Bvh::intersect(const Ray& ray, Hit& hit) const {
  if (nodes_.empty()) return false;
  const Vec3 inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
  std::array<std::size_t, stack_size> stack{};
  std::size_t waiting = 1;
  bool found = false;
  while (waiting > 0) {
    const std::size_t at = stack[--waiting];
    const Node& node = nodes_[at];
    if (!meets(node.bounds, ray, inverse, hit.t)) continue;
    for (std::size_t i = 0; i < node.count; ++i) {
      if (order_[node.first + i]->intersect(ray, hit)) found = true;
    }
    if (node.count > 0) continue;
    // The nearer child goes last, to be looked at first.
    const bool goes_up = ray.direction.*node.split > 0;
    stack[waiting++] = goes_up ? node.first : at + 1;
    stack[waiting++] = goes_up ? at + 1 : node.first;
  }
  return found;
}

}  // namespace defray
