#include "splat/surfels/smoothing.h"

#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "splat/surfels/ridges.h"

namespace defray {
namespace {

/// How often, and how far around a point others count, a Gaussian's deviation in spacings.
constexpr int rounds = 3;
constexpr double reach = 1.2;
/// What lies this share of its distance above a surface is not of it, and a point that stands for
/// as much more as this than one around it does not lie on that one's: strays.
constexpr double far_above = 0.5, much_larger = 1.5;

constexpr double square(double x) { return x * x; }

/// What a neighbour says of a point.
struct Saying {
  Vec3 d;               ///< From the point to it.
  double above = 0;     ///< How far it is above a surface through both that curves evenly,
  double height = 0;    ///< and as a share of what is too far, squared.
  double likeness = 0;  ///< Of the two normals, and how near it is: 0 to 1.
};

Saying saying(const CloudPoints& cloud, std::size_t point, std::size_t other) {
  const CloudPoint &own = cloud.points[point], &there = cloud.points[other];
  Saying s{.d = cloud.place(other) - cloud.place(point)};
  const double same = (dot(own.normal, there.normal) - ridge_cosine) / (1 - ridge_cosine);
  const bool is_alike = same > 0 && own.spacing < much_larger * there.spacing;
  if (!is_alike || !(dot(s.d, s.d) > 0)) return s;
  // On a circle through two points with their normals the mean of those is square to what is
  // between them.
  s.above = dot(s.d, normalized(own.normal + there.normal));
  s.height = square(s.above / far_above) / dot(s.d, s.d);
  if (s.height >= 1) return s;
  s.likeness = same * std::exp(-0.5 * dot(s.d, s.d) / square(reach * own.spacing));
  return s;
}

/// Where along a point's normal those around have the surface.
Vec3 place_of_others(const CloudPoints& cloud, std::size_t point) {
  double weights = 1, sum = 0;
  for (const std::uint32_t other : cloud.around.of(point)) {
    const Saying s = saying(cloud, point, other);
    const double weight = s.likeness * square(1 - s.height);
    weights += weight;
    sum += weight * s.above;
  }
  return cloud.place(point) + cloud.points[point].normal * (sum / weights);
}

/// The mean of a point's normal and what it is on circles through those around with theirs.
Vec3 mean_normal(const CloudPoints& cloud, std::size_t point) {
  Vec3 sum = cloud.points[point].normal;
  for (const std::uint32_t other : cloud.around.of(point)) {
    const Saying s = saying(cloud, point, other);
    if (!(s.likeness > 0)) continue;
    const Vec3& normal = cloud.points[other].normal;
    sum = sum + (normal - s.d * (2 * dot(normal, s.d) / dot(s.d, s.d))) * s.likeness;
  }
  return normalized(sum);
}

/// What a function says of each point.
template <typename Function>
std::vector<Vec3> of_all(const CloudPoints& cloud, const Function& function) {
  std::vector<Vec3> values(cloud.points.size());
  parallel_for_each(values.size(), [&](std::size_t i) { values[i] = function(cloud, i); });
  return values;
}

void smooth_places(CloudPoints& cloud) {
  const std::vector<Vec3> places = of_all(cloud, place_of_others);
  for (std::size_t i = 0; i < places.size(); ++i) {
    cloud.places[i] = {static_cast<float>(places[i].x), static_cast<float>(places[i].y),
                       static_cast<float>(places[i].z)};
  }
}

void smooth_normals(CloudPoints& cloud) {
  const std::vector<Vec3> normals = of_all(cloud, mean_normal);
  for (std::size_t i = 0; i < normals.size(); ++i) cloud.points[i].normal = normals[i];
}

}  // namespace

void smooth(CloudPoints& cloud) {
  for (int i = 0; i < rounds; ++i) {
    smooth_places(cloud);
    smooth_normals(cloud);
  }
}

}  // namespace defray
