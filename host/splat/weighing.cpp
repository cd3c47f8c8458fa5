// Weights of a cloud's points: Krivanek & Zara 2003, section 6.3, but found on the surface itself
// instead of in rendered pictures.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "splat/cloud_points.h"

namespace defray {
namespace {

/// Steps in which weights are found, and where around a point sums are looked at: as far as this
/// along two axes, in distances of points. Twice the steps raise the least sum of points in random
/// places from 0.91 to 0.93.
constexpr int weighing_steps = 4;
constexpr double look_at = 0.5;
/// Sums should be no less than 1, where what is behind would shine through; what is more does not
/// count (SplatMerge).
constexpr double aim = 1.03;

/// Places on the surface around a point.
std::array<Vec3, 5> sites_of(const CloudPoints& cloud, std::size_t point) {
  const Vec3 at = cloud.place(point), normal = cloud.points[point].normal;
  const Vec3 beside =
      normalized(cross(normal, std::abs(normal.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const double far = look_at * cloud.points[point].spacing;
  const Vec3 u = beside * far, v = cross(normal, beside) * far;
  return {at, at + u, at - u, at + v, at - v};
}

/// Finds areas with which the basis functions add up to 1 all over the surface, by the steps of
/// Richardson and Lucy: each area times the mean, by its own basis function, of what sums lack.
class Weighing {
 public:
  explicit Weighing(const CloudPoints& cloud)
      : cloud_(cloud), areas_(cloud.points.size()), lacks_(cloud.points.size()) {
    for (std::size_t i = 0; i < areas_.size(); ++i) areas_[i] = square(cloud.points[i].spacing);
  }

  void step() {
    parallel_for_each(areas_.size(), [&](std::size_t i) { look(i); });
    std::vector<double> next(areas_.size());
    parallel_for_each(areas_.size(), [&](std::size_t i) { next[i] = areas_[i] * factor(i); });
    areas_ = std::move(next);
  }

  std::vector<double> take() && { return std::move(areas_); }

 private:
  static double square(double x) { return x * x; }

  /// What a point's basis function of unit area covers at a place, seen along the normal there:
  /// where the surface bends, its points are closer to each other, and show less of their areas.
  double basis(std::size_t of, const Vec3& place, const Vec3& normal) const {
    const CloudPoint& point = cloud_.points[of];
    const double same = dot(point.normal, normal);
    const double facing = cloud_.is_oriented ? std::max(same, 0.0) : std::abs(same);
    const Vec3 d = place - cloud_.place(of);
    const double variance = square(basis_deviation * point.spacing), beside = dot(d, normal);
    return facing * std::exp(-0.5 * (dot(d, d) - beside * beside) / variance) /
           (2 * M_PI * variance);
  }

  void look(std::size_t point) {
    const auto sites = sites_of(cloud_, point);
    const Vec3& normal = cloud_.points[point].normal;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      double sum = areas_[point] * basis(point, sites[k], normal);
      for (const std::uint32_t i : cloud_.around.of(point)) {
        sum += areas_[i] * basis(i, sites[k], normal);
      }
      lacks_[point][k] = static_cast<float>(aim * cloud_.points[point].covered / sum);
    }
  }

  double factor(std::size_t point) const {
    double weights = 0, sum = 0;
    const auto add = [&](std::size_t around) {
      const auto sites = sites_of(cloud_, around);
      for (std::size_t k = 0; k < sites.size(); ++k) {
        const double weight = basis(point, sites[k], cloud_.points[around].normal);
        weights += weight;
        sum += weight * static_cast<double>(lacks_[around][k]);
      }
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    return sum / weights;
  }

  const CloudPoints& cloud_;
  std::vector<double> areas_;
  std::vector<std::array<float, 5>>
      lacks_;  ///< What sums at a point's sites are to be multiplied by.
};

}  // namespace

std::vector<double> weighed_areas(const CloudPoints& cloud, const Progress& progress) {
  Weighing weighing(cloud);
  for (int i = 0; i < weighing_steps; ++i) {
    weighing.step();
    if (progress) progress(static_cast<double>(i + 1) / weighing_steps);
  }
  return std::move(weighing).take();
}

}  // namespace defray
