#pragma once
// Points of a cloud on their way to surfels.
#include <algorithm>
#include <array>
#include <vector>

#include "base/vec3.h"
#include "defray/report.h"
#include "kernels/splat_params.h"
#include "splat/surfels/neighbours.h"

namespace defray {

/// As many decide on a normal and a weight: all that a basis function reaches, and a few.
inline constexpr std::size_t neighbour_count = 20;

/// Standard deviation of a basis function in distances of points. Of grids, square or hexagonal,
/// the sum then varies by 1 to 2 % at c = 2.5; by 3 to 4 % if it is that of a disc around a point,
/// 0.6.
inline constexpr double basis_deviation = 0.8;

/// Places beside a point where sums of basis functions are looked at.
inline constexpr std::size_t site_count = 7;

/// What is known of a point.
struct CloudPoint {
  Vec3 normal;                ///< Unit.
  bool is_two_sided = false;  ///< Which side is outside is not known.
  double spacing = 0;         ///< Radius of the disc that it stands for.
  double covered = 1;         ///< Share of the basis function's reach where there is a surface.
  /// How far from it sums of basis functions are looked at, in spacings; in cells.h's directions.
  std::array<float, site_count> sites{};
  /// From it along its surface to the nearest places of the ridges at which that ends; or nothing.
  std::array<Vec3, DEFRAY_SPLAT_RIDGES> ridges{};
};

/// All points, with those around them.
struct CloudPoints {
  std::vector<std::array<float, 3>> places;
  std::vector<CloudPoint> points;
  Neighbours around;
  bool is_closed = false;  ///< What has one side has no edges.

  Vec3 place(std::size_t i) const { return {places[i][0], places[i][1], places[i][2]}; }

  /// Whether normals with this cosine between them, of at most `least`, set two points apart. Those
  /// of what has two sides do not.
  bool are_apart(std::size_t i, std::size_t j, double cosine, double least) const {
    return !(cosine > least) && !points[i].is_two_sided && !points[j].is_two_sided;
  }

  /// Whether a point's face ends before another.
  bool is_beyond_ridge(std::size_t of, std::size_t at) const {
    const Vec3 d = place(at) - place(of);
    return std::any_of(points[of].ridges.begin(), points[of].ridges.end(), [&](const Vec3& to) {
      const double square = dot(to, to);
      return square > 0 && dot(d, to) > square;
    });
  }
};

/// What the places around a point say of a surface there.
struct EstimatedSurface {
  Vec3 middle;
  /// The direction in which they vary least; of points along a line, or alone, one across it, along
  /// z if it can be.
  Vec3 normal;
  double thickness;  ///< Of their variance the share along the normal: 0 to 1/3.
  bool is_line;      ///< All of them lie along one.
};
EstimatedSurface estimate_surface(const CloudPoints& cloud, std::size_t point);

/// Mean distance of the closest points that are not in the same place, where points are nearer to
/// each other on one side those on the other, in sides of a square grid's squares; 0 if all are in
/// one place.
double spacing_of(const CloudPoints& cloud, std::size_t point);

/// What a point stands for.
struct PointWeight {
  double area;   ///< With which basis functions add up to 1 on average.
  double cover;  ///< Times this they add up to no less than 1 anywhere.
};

/// Of all points.
std::vector<PointWeight> weigh(const CloudPoints& cloud, const Progress& progress);

}  // namespace defray
