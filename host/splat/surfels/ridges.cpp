#include "splat/surfels/ridges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"

namespace defray {
namespace {

// Lengths are in spacings. What chose the numbers: icosahedra, cubes, cylinders and balls whose
// normals are off by 5 to 40 degrees (perf/notes/point_clouds.md).

/// Normals with this cosine between them or less are those of the two sides of what is thin.
constexpr double opposite_sides = -0.96;
/// As far from a ridge basis functions reach over it.
constexpr double widest_reach = 1.8;
/// How far along a ridge the other face's point may lie.
constexpr double widest_beside = 1.5;
/// A point as near to a ridge may be on either side of it, as those are that lie on edges of
/// meshes; its face ends no nearer to it than least_reach.
constexpr double on_ridge = 0.1, least_reach = 0.02;
/// Ridges in directions with this cosine between them or more are one.
constexpr double one_way = 0.8;
/// Where points lie, and normals point, is not exact: of what several points say of a ridge the
/// farthest counts, up to this much beyond the nearest, or both faces would end before it.
constexpr double most_doubt = 1;
/// Where the other face's points lie farther from a ridge, as random ones do, this face reaches
/// over it by as much.
constexpr double last_row = 0.75;
/// Points of a face have normals that differ by no more than this share of what its own differ by
/// from the other's, and lie no farther from its plane than this share of how far away they are.
/// So many of those around, and of each face, do so, or normals are just noisy: of balls' points
/// whose normals are off by 5 to 40 degrees 1.2 % or fewer pass, of icosahedra's at ridges all.
constexpr double alike = 1.0 / 3, flat = 0.15, most_around = 0.35;
constexpr std::size_t least_of_a_face = 3;

/// Where a point's tangent plane meets that of another. If both points lie there they do not say on
/// which side their faces are, and the distance is infinite.
struct Ridge {
  Vec3 way;                 ///< Across it, unit.
  double distance, beyond;  ///< Of the point, and of the other.
  std::uint32_t other;
};

std::optional<Ridge> ridge_between(const CloudPoints& cloud, std::size_t point,
                                   std::uint32_t other) {
  const CloudPoint &own = cloud.points[point], &there = cloud.points[other];
  const double cosine = dot(own.normal, there.normal);
  if (cosine > ridge_cosine || cosine < opposite_sides || there.is_two_sided) return std::nullopt;
  const Vec3 d = (cloud.place(other) - cloud.place(point)) / own.spacing;
  const double sine = std::sqrt(1 - cosine * cosine);
  const Vec3 along = (there.normal - own.normal * cosine) / sine;
  // Below 0 in a valley.
  const double distance = dot(d, there.normal) / sine, beyond = -dot(d, own.normal) / sine;
  const double least = std::min(distance, beyond), most = std::max(distance, beyond);
  if (std::max(-least, most) > widest_reach) return std::nullopt;
  if (std::abs(dot(d, cross(own.normal, along))) > widest_beside) return std::nullopt;
  if (least >= -on_ridge && most <= on_ridge) return Ridge{{}, INFINITY, 0, other};
  // Faces that cross, or of which one goes on under the other, end there from either side.
  const bool crosses = least < -on_ridge && most > on_ridge;
  const double side = (crosses ? distance > 0 : most > on_ridge) ? 1 : -1;
  return Ridge{along * side, std::max(side * distance, least_reach), std::abs(beyond), other};
}

/// Whether normals and places around a point are those of its face and of another's.
bool has_two_faces(const CloudPoints& cloud, std::size_t point, std::uint32_t other) {
  const double angle =
      std::acos(std::clamp(dot(cloud.points[point].normal, cloud.points[other].normal), -1.0, 1.0));
  const double cosine = std::cos(alike * angle);
  const auto around = cloud.around.of(point);
  const auto count_on = [&](std::size_t face) {
    const Vec3& normal = cloud.points[face].normal;
    return std::count_if(around.begin(), around.end(), [&](std::uint32_t i) {
      const Vec3 d = cloud.place(i) - cloud.place(face);
      return dot(cloud.points[i].normal, normal) > cosine &&
             std::abs(dot(d, normal)) <= flat * length(d);
    });
  };
  const auto own = static_cast<std::size_t>(count_on(point));
  const auto others = static_cast<std::size_t>(count_on(other));
  return static_cast<double>(own + others) >= most_around * static_cast<double>(around.size()) &&
         std::min(own, others) >= least_of_a_face;
}

/// How far a point's face reaches, from the nearest of some ridges and those in its direction,
/// which it takes out.
double take_reach(const CloudPoints& cloud, std::vector<Ridge>& ridges, const Ridge& nearest) {
  double farthest = 0, beyond = nearest.beyond;
  std::erase_if(ridges, [&](const Ridge& r) {
    if (std::isinf(r.distance) &&
        dot(cloud.points[r.other].normal, cloud.points[nearest.other].normal) > one_way) {
      beyond = 0;
    }
    if (dot(r.way, nearest.way) <= one_way) return false;
    farthest = std::max(farthest, r.distance);
    beyond = std::min(beyond, r.beyond);
    return true;
  });
  return std::min(farthest, nearest.distance + most_doubt) + std::max(0.0, beyond - last_row);
}

void find_at(CloudPoints& cloud, std::size_t point) {
  CloudPoint& own = cloud.points[point];
  if (own.is_two_sided) return;
  std::vector<Ridge> ridges;
  for (const std::uint32_t other : cloud.around.of(point)) {
    if (const auto ridge = ridge_between(cloud, point, other)) ridges.push_back(*ridge);
  }
  for (Vec3& to : own.ridges) {
    if (ridges.empty()) return;
    const Ridge nearest =
        *std::min_element(ridges.begin(), ridges.end(),
                          [](const Ridge& a, const Ridge& b) { return a.distance < b.distance; });
    if (std::isinf(nearest.distance) || !has_two_faces(cloud, point, nearest.other)) return;
    to = nearest.way * (own.spacing * take_reach(cloud, ridges, nearest));
  }
}

}  // namespace

void find_ridges(CloudPoints& cloud) {
  parallel_for_each(cloud.points.size(), [&](std::size_t i) { find_at(cloud, i); });
}

}  // namespace defray
