#include "splat/surfels/cloud_points.h"

#include <algorithm>
#include <numbers>

#include "splat/surfels/spread.h"

namespace defray {
namespace {

/// The nearest of a square grid's point, those on one side of it, and their mean distance in sides
/// of its squares.
constexpr std::size_t close_count = 8, beside_count = 3;
constexpr double close_distance = (4 + 4 * std::numbers::sqrt2) / 8;

/// A line's variance across, of that along it. Of a grid with rows so far apart that the twenty
/// nearest of a point are its own row's, 8 and more distances, with noise of 0.1 distances, it is
/// 0.0003; at 6, which leave no gaps, 0.1.
constexpr double widest_line = 0.01;

}  // namespace

EstimatedSurface estimate_surface(const CloudPoints& cloud, std::size_t point) {
  std::vector<Vec3> places{cloud.place(point)};
  for (const std::uint32_t i : cloud.around.of(point)) places.push_back(cloud.place(i));
  const Spread spread = spread_of(places);
  const auto [most, middle, least] = spread.variances;
  EstimatedSurface found{spread.mean, spread.axes[2], spread.thickness(),
                         middle < widest_line * most};
  if (middle > 1e-12 * most) return found;
  // Along a line, or alone: any direction across will do.
  const Vec3 line = most > 0 ? spread.axes[0] : Vec3{};
  const Vec3 towards = std::abs(line.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  found.normal = normalized(towards - line * dot(line, towards));
  return found;
}

double spacing_of(const CloudPoints& cloud, std::size_t point) {
  const std::size_t most = cloud.around.coarser(point).empty() ? close_count : beside_count;
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t i : cloud.around.alike(point)) {
    const double distance = length(cloud.place(i) - cloud.place(point));
    if (!(distance > 0)) continue;
    sum += distance;
    if (++count == most) break;
  }
  return count > 0 ? sum / static_cast<double>(count) / close_distance : 0;
}

}  // namespace defray
