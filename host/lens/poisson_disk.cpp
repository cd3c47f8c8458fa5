#include "lens/poisson_disk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/random.h"

namespace defray {
namespace {

using DiskPoint = std::array<double, 2>;

/// Whether p and its antipode keep this distance from each other and from all points.
bool keeps_distance(const std::vector<DiskPoint>& points, const DiskPoint& p, double spacing) {
  if (2 * std::hypot(p[0], p[1]) < spacing) return false;
  // The points are closed under negation: those far enough from p are so from -p too.
  return std::all_of(points.begin(), points.end(), [&](const DiskPoint& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1]) >= spacing;
  });
}

/// A point of the disc of this radius.
DiskPoint dart(Random& random, double largest_radius) {
  const double radius = largest_radius * std::sqrt(random.next());
  const double angle = 2 * std::numbers::pi * random.next();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The first dart that keeps its distance, if one of so many does. Points stand for the area around
/// them: they stay a quarter of their spacing inside the rim, or sets would crowd there and blur
/// wider than the disc.
std::optional<DiskPoint> throw_darts(Random& random, const std::vector<DiskPoint>& points,
                                     double spacing, int darts) {
  for (int i = 0; i < darts; ++i) {
    const DiskPoint p = dart(random, 1 - spacing / 4);
    if (keeps_distance(points, p, spacing)) return p;
  }
  return std::nullopt;
}

/// Spacing of `count` points on a hexagonal grid that covers the unit disc.
double hexagonal_spacing(int count) {
  return std::sqrt(2 * std::numbers::pi / (std::numbers::sqrt3 * count));
}

}  // namespace

PoissonDisk make_poisson_disk(int count, std::uint32_t seed) {
  if (count < 1 || count > poisson_disk_max_count) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to {}", field("samples"), count,
         poisson_disk_max_count);
  }
  constexpr int darts = 400;
  constexpr double tightest = 0.8, shrink = 0.98;
  PoissonDisk disk;
  Random random(0, 0, seed);
  double spacing = 2;
  if (count % 2 == 1) {
    disk.points.push_back({0, 0});
    disk.spacing.push_back(spacing);
  }
  while (static_cast<int>(disk.points.size()) < count) {
    // A set packed as tightly as it can be leaves no room for chance.
    const int grown = static_cast<int>(disk.points.size()) + 2;
    spacing = std::min(spacing, tightest * hexagonal_spacing(grown));
    std::optional<DiskPoint> p = throw_darts(random, disk.points, spacing, darts);
    for (; !p; p = throw_darts(random, disk.points, spacing, darts)) spacing *= shrink;
    disk.points.insert(disk.points.end(), {*p, {-(*p)[0], -(*p)[1]}});
    disk.spacing.insert(disk.spacing.end(), 2, spacing);
  }
  return disk;
}

}  // namespace defray
