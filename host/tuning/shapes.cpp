#include "tuning/shapes.h"

#include <algorithm>
#include <set>

#include "base/random.h"
#include "opencl/launch_table.h"

namespace defray::tuning {
namespace {

constexpr std::size_t most_x = 256, most_y = 16, most_in_all = 1024;
constexpr std::size_t to_confirm = 2;

/// Half or double a side, or one at the other's cost.
bool is_beside(const Shape& a, const Shape& b) {
  const auto is_step = [](std::size_t p, std::size_t q) { return p == 2 * q || q == 2 * p; };
  if (a.x == b.x) return is_step(a.y, b.y);
  return is_step(a.x, b.x) && (a.y == b.y || a.x * a.y == b.x * b.y);
}

}  // namespace

Shape own_shape(const std::string& kernel, bool on_gpu) {
  const WorkGroup own = launch_of(kernel).group_on(on_gpu);
  return {own.x, std::max<std::size_t>(own.y, 1)};
}

std::vector<Shape> shapes_of(const std::string& kernel, const Machine& machine) {
  const Shape own = own_shape(kernel, machine.is_gpu);
  const std::size_t tallest = launch_of(kernel).group.y == 0 ? 1 : most_y;
  std::vector<Shape> shapes{own};
  for (std::size_t y = 1; y <= tallest; y *= 2) {
    for (std::size_t x = 1; x <= most_x; x *= 2) {
      if (x * y <= std::min(machine.most_items, most_in_all) && Shape{x, y} != own)
        shapes.push_back({x, y});
    }
  }
  return shapes;
}

std::optional<Shape> next_to_explore(const std::vector<Result>& results, const Place& place,
                                     const Machine& machine) {
  std::set<Shape> tried;
  for (const Result& r : results) {
    if (r.place == place) tried.insert(r.shape);
  }
  std::vector<Shape> untried;
  for (const Shape& s : shapes_of(place.kernel, machine)) {
    if (!tried.contains(s)) untried.push_back(s);
  }
  if (untried.empty()) return {};
  if (tried.empty()) return untried.front();
  const auto tries = tries_at(results, place);
  if (!tries.empty() && tried.size() % 2 == 1) {
    for (const Shape& s : untried) {
      if (is_beside(s, tries.front()->shape)) return s;
    }
  }
  const double chance = Random(static_cast<int>(tried.size()), 0, 0).next();
  return untried[static_cast<std::size_t>(chance * static_cast<double>(untried.size()))];
}

Shape next_to_confirm(const std::vector<Result>& results, const Place& place, bool on_gpu) {
  const Shape own = own_shape(place.kernel, on_gpu);
  auto tries = tries_at(results, place);
  const auto at_own =
      std::find_if(tries.begin(), tries.end(), [&](const Result* r) { return r->shape == own; });
  if (at_own == tries.end()) return own;
  std::rotate(tries.begin(), at_own, at_own + 1);  // own, then the fastest
  tries.resize(std::min(tries.size(), 1 + to_confirm));
  const auto fewest = std::min_element(tries.begin(), tries.end(), [](auto a, auto b) {
    return a->run_ms.size() < b->run_ms.size();
  });
  return (*fewest)->shape;
}

}  // namespace defray::tuning
