#include "splat/surfels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/vec3.h"
#include "splat/neighbours.h"

namespace defray {
namespace {

/// As many decide on a normal and a weight: all that a basis function reaches, and a few.
constexpr std::size_t neighbour_count = 20;
/// The nearest of a square grid's point, and their mean distance in sides of its squares.
constexpr std::size_t close_count = 8;
constexpr double close_distance = (4 + 4 * std::numbers::sqrt2) / 8;
/// Standard deviation of a basis function in distances of points. Of grids, square or hexagonal,
/// the sum then varies by 1 to 2 % at c = 2.5; by 3 to 4 % if it is that of a disc around a point,
/// 0.6.
constexpr double deviation = 0.8;
/// Steps in which weights are found, and where around a point sums are looked at: as far as this
/// along two axes, in distances of points.
constexpr int weighing_steps = 4;
constexpr double look_at = 0.5;
/// Sums should be no less than 1, where what is behind would shine through; what is more does not
/// count (SplatMerge).
constexpr double aim = 1.03;
/// A point's neighbours lie around it; where their mean is further from it than this, in units of
/// the farthest's distance, the surface ends, and half of what a basis function reaches is beyond
/// where it is as far as at a straight edge.
constexpr double inner_offset = 0.22, edge_offset = 0.42;

Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

bool is_finite(const std::array<float, 3>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// What is known of a point on its way to a surfel.
struct Point {
  Vec3 normal;         ///< Unit.
  double spacing = 0;  ///< Radius of the disc that it stands for.
  double covered = 1;  ///< Share of the basis function's reach where there is a surface.
};

/// All points, with those around them.
struct Cloud {
  std::vector<std::array<float, 3>> places;
  std::vector<Point> points;
  Neighbours around;

  Vec3 place(std::size_t i) const { return vec(places[i]); }
};

/// The direction in which places vary least.
Vec3 estimated_normal(const Cloud& cloud, std::size_t point) {
  const auto around = cloud.around.of(point);
  Vec3 mean = cloud.place(point);
  for (const std::uint32_t i : around) mean = mean + cloud.place(i);
  mean = mean / static_cast<double>(around.size() + 1);
  cv::Matx33d covariance = cv::Matx33d::zeros();
  const auto add = [&](std::size_t i) {
    const Vec3 d = cloud.place(i) - mean;
    const cv::Vec3d v(d.x, d.y, d.z);
    covariance += v * v.t();
  };
  add(point);
  for (const std::uint32_t i : around) add(i);
  cv::Vec3d values;
  cv::Matx33d vectors;
  cv::eigen(covariance, values, vectors);  // the largest first
  return {vectors(2, 0), vectors(2, 1), vectors(2, 2)};
}

/// Share of a basis function's reach where there is a surface, from where the neighbours lie.
double covered_share(const Cloud& cloud, std::size_t point) {
  const auto around = cloud.around.of(point);
  Vec3 mean{};
  double farthest = 0;
  for (const std::uint32_t i : around) {
    const Vec3 d = cloud.place(i) - cloud.place(point);
    mean = mean + d;
    farthest = std::max(farthest, length(d));
  }
  if (!(farthest > 0)) return 1;
  const double offset = length(mean) / static_cast<double>(around.size()) / farthest;
  return 1 - 0.5 * std::clamp((offset - inner_offset) / (edge_offset - inner_offset), 0.0, 1.0);
}

/// Mean distance of the closest points that are not in the same place; 0 if all are.
double spacing_of(const Cloud& cloud, std::size_t point) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t i : cloud.around.of(point)) {
    const double distance = length(cloud.place(i) - cloud.place(point));
    if (!(distance > 0)) continue;
    sum += distance;
    if (++count == close_count) break;
  }
  return count > 0 ? sum / static_cast<double>(count) / close_distance : 0;
}

/// Places on the surface around a point.
std::array<Vec3, 5> sites_of(const Cloud& cloud, std::size_t point) {
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
  explicit Weighing(const Cloud& cloud)
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

  /// A point's basis function of unit area, at a place.
  double basis(std::size_t of, const Vec3& place) const {
    const Point& point = cloud_.points[of];
    const Vec3 d = place - cloud_.place(of);
    const double variance = square(deviation * point.spacing), beside = dot(d, point.normal);
    return std::exp(-0.5 * (dot(d, d) - beside * beside) / variance) / (2 * M_PI * variance);
  }

  void look(std::size_t point) {
    const auto sites = sites_of(cloud_, point);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      double sum = areas_[point] * basis(point, sites[k]);
      for (const std::uint32_t i : cloud_.around.of(point)) sum += areas_[i] * basis(i, sites[k]);
      lacks_[point][k] = static_cast<float>(aim * cloud_.points[point].covered / sum);
    }
  }

  double factor(std::size_t point) const {
    double weights = 0, sum = 0;
    const auto add = [&](std::size_t around) {
      const auto sites = sites_of(cloud_, around);
      for (std::size_t k = 0; k < sites.size(); ++k) {
        const double weight = basis(point, sites[k]);
        weights += weight;
        sum += weight * static_cast<double>(lacks_[around][k]);
      }
    };
    add(point);
    for (const std::uint32_t i : cloud_.around.of(point)) add(i);
    return sum / weights;
  }

  const Cloud& cloud_;
  std::vector<double> areas_;
  std::vector<std::array<float, 5>>
      lacks_;  ///< What sums at a point's sites are to be multiplied by.
};

std::vector<double> weighed_areas(const Cloud& cloud, const Progress& progress) {
  Weighing weighing(cloud);
  for (int i = 0; i < weighing_steps; ++i) {
    weighing.step();
    if (progress) progress(static_cast<double>(i + 1) / weighing_steps);
  }
  return std::move(weighing).take();
}

void check_counts(const PointCloud& cloud) {
  const std::size_t points = cloud.positions.size();
  const auto check = [&](const char* what, std::size_t count) {
    if (count == 0 || count == points) return;
    fail(ErrorKind::usage, "{} has {} values: the cloud has {} points", field(what), count, points);
  };
  check("normals", cloud.normals.size());
  check("radii", cloud.radii.size());
  check("colours", cloud.colours.size());
  check("alpha", cloud.alpha.size());
}

/// The points that have a place, in their order; notes what is left out.
std::vector<std::uint32_t> placed_points(const PointCloud& cloud, Surfels& out) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    if (is_finite(cloud.positions[i])) kept.push_back(i);
  }
  if (kept.empty()) {
    fail(ErrorKind::input, "the cloud has no points{}",
         cloud.positions.empty() ? "" : " with a finite place");
  }
  if (const std::size_t lost = cloud.positions.size() - kept.size(); lost > 0) {
    out.notes.push_back(fmt::format("{} of {} points have no finite place: left out", lost,
                                    cloud.positions.size()));
  }
  return kept;
}

/// Spacings, given or from the points around; of a single point there are none around.
void set_spacings(const PointCloud& given_cloud, const std::vector<std::uint32_t>& kept,
                  Cloud& cloud, Surfels& out) {
  std::vector<Point>& points = cloud.points;
  std::size_t without = 0;
  std::vector<double> known;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float given = given_cloud.radii.empty() ? 0 : given_cloud.radii[kept[i]];
    const bool is_given = std::isfinite(given) && given > 0;
    without += !given_cloud.radii.empty() && !is_given;
    points[i].spacing = is_given ? static_cast<double>(given) : spacing_of(cloud, i);
    if (points[i].spacing > 0) known.push_back(points[i].spacing);
  }
  if (known.empty()) {
    fail(ErrorKind::input,
         "the cloud's {} all lie in one place, and say nothing of their size: give them a radius",
         points.size() == 1 ? "points (one)" : "points");
  }
  if (without > 0) {
    out.notes.push_back(
        fmt::format("{} points have no radius above 0: estimated from those around", without));
  }
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2),
                   known.end());
  for (Point& p : points) {
    if (!(p.spacing > 0)) p.spacing = known[known.size() / 2];
  }
}

/// Unit normals, given or estimated.
void set_normals(const PointCloud& given_cloud, const std::vector<std::uint32_t>& kept,
                 Cloud& cloud, Surfels& out) {
  std::vector<Point>& points = cloud.points;
  std::vector<std::uint8_t> is_given(points.size(), 0);
  parallel_for_each(points.size(), [&](std::size_t i) {
    if (!given_cloud.normals.empty() && is_finite(given_cloud.normals[kept[i]])) {
      const Vec3 given = vec(given_cloud.normals[kept[i]]);
      is_given[i] = length(given) > 1e-20;
      if (is_given[i]) points[i].normal = normalized(given);
    }
    if (!is_given[i]) points[i].normal = estimated_normal(cloud, i);
  });
  const auto given = std::count(is_given.begin(), is_given.end(), 1);
  out.has_normals = given > 0;
  if (out.has_normals && given < static_cast<std::ptrdiff_t>(points.size())) {
    out.notes.push_back(fmt::format("{} points have no normal: estimated from those around",
                                    points.size() - static_cast<std::size_t>(given)));
  }
}

DefraySplatNode surfel_of(const PointCloud& cloud, std::uint32_t index, const Point& point,
                          double area) {
  DefraySplatNode n{};
  const auto& place = cloud.positions[index];
  n.x = place[0];
  n.y = place[1];
  n.z = place[2];
  const Vec3 spanned = point.normal * area;
  n.area_x = static_cast<float>(spanned.x);
  n.area_y = static_cast<float>(spanned.y);
  n.area_z = static_cast<float>(spanned.z);
  n.variance = static_cast<float>(std::pow(deviation * point.spacing, 2));
  constexpr float grey = 0.5f;
  n.a = cloud.alpha.empty() ? 1 : cloud.alpha[index];
  n.r = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][0]);
  n.g = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][1]);
  n.b = n.a * (cloud.colours.empty() ? grey : cloud.colours[index][2]);
  return n;
}

void check_colours(const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.colours.size(); ++i) {
    if (is_finite(cloud.colours[i])) continue;
    fail(ErrorKind::input, "point {} has the colour {} {} {}: allowed are finite numbers", i,
         cloud.colours[i][0], cloud.colours[i][1], cloud.colours[i][2]);
  }
  for (std::size_t i = 0; i < cloud.alpha.size(); ++i) {
    if (cloud.alpha[i] >= 0 && cloud.alpha[i] <= 1) continue;
    fail(ErrorKind::input, "point {} has alpha {}: allowed are 0 to 1", i, cloud.alpha[i]);
  }
}

}  // namespace

Surfels make_surfels(const PointCloud& cloud, const Progress& progress) {
  check_counts(cloud);
  check_colours(cloud);
  Surfels out;
  out.has_colours = !cloud.colours.empty();
  const std::vector<std::uint32_t> kept = placed_points(cloud, out);
  std::vector<std::array<float, 3>> places;
  for (const std::uint32_t i : kept) places.push_back(cloud.positions[i]);
  Neighbours around(places, neighbour_count);
  Cloud known{std::move(places), std::vector<Point>(kept.size()), std::move(around)};
  set_spacings(cloud, kept, known, out);
  set_normals(cloud, kept, known, out);
  parallel_for_each(kept.size(),
                    [&](std::size_t i) { known.points[i].covered = covered_share(known, i); });
  const std::vector<double> areas = weighed_areas(known, progress);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    out.points.push_back(surfel_of(cloud, kept[i], known.points[i], areas[i]));
  }
  return out;
}

}  // namespace defray
