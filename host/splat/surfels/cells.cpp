#include "splat/surfels/cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "splat/surfels/ridges.h"

namespace defray {
namespace {

/// Directions in which a cell's border is found: some between two sites.
constexpr std::size_t finer = 4, direction_count = finer * site_count;
/// Where no neighbour lies within this angle's cosine of a direction, nothing ends the cell: the
/// surface may. Neighbours then leave out 130 degrees or more, as 0.2 % of points in random places
/// have it, all in a surface's last row, and with this many others around of which it is so none of
/// the former (grids jittered by up to 0.4 spacings, and random squares, of 14 400 points).
constexpr double alone_within = 0.4226;
constexpr std::size_t others_at_edges = 2;
/// Points as near to a surface's end, in spacings, may reach over it.
constexpr double beside_edge = 2;
/// Faces at an edge sharper than this cosine between their normals are two sides of a thin body,
/// and do not end each other's cells: cubes', tetrahedra's and wedges' of 60 degrees do. Else the
/// last points before an edge reach as far as those beside a hole.
constexpr double opposite = -0.8;
/// Cells are no wider than this, in spacings.
constexpr double widest_cell = 2;
/// Sums are looked at beyond cells' borders by this, but no farther than most_reach; along edges,
/// which would grow, and of radii that are given, as near as near_reach. With perf/notes/
/// point_clouds.md's cloud of random points.
constexpr double beyond_border = 1.2, most_reach = 1.5, near_reach = 0.5;
/// A point's neighbours lie around it; where their mean is further from it than this, in units of
/// the farthest's distance, the surface ends, and half of what a basis function reaches is beyond
/// where it is as far as at a straight edge.
constexpr double inner_offset = 0.22, edge_offset = 0.42;

template <std::size_t count>
std::array<Direction, count> directions_around() {
  std::array<Direction, count> all{};
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / count;
    all[k] = {std::cos(angle), std::sin(angle)};
  }
  return all;
}

/// A point's Voronoi cell on its tangent plane, in spacings.
struct Cell {
  std::array<float, site_count> border;  ///< How far it is in the sites' directions.
  float farthest;                        ///< Of all borders that a neighbour makes.
  bool ends;                             ///< In some direction there is none.
};

/// How far a cell is in all directions, as one thing after the other ends it.
struct Borders {
  std::array<double, direction_count> at;
  std::array<bool, direction_count> are_known{};

  Borders() { at.fill(widest_cell); }

  /// By a line across (x, y), which is unit.
  void end(double x, double y, double distance) {
    static const auto directions = directions_around<direction_count>();
    for (std::size_t k = 0; k < direction_count; ++k) {
      const double along = x * directions[k].x + y * directions[k].y;
      if (along > 0) at[k] = std::min(at[k], distance / along);
      are_known[k] = are_known[k] || along > alone_within;
    }
  }

  Cell cell() const {
    Cell cell{};
    for (std::size_t k = 0; k < site_count; ++k) {
      cell.border[k] = static_cast<float>(at[finer * k]);
    }
    for (std::size_t k = 0; k < direction_count; ++k) {
      if (are_known[k]) cell.farthest = std::max(cell.farthest, static_cast<float>(at[k]));
      cell.ends = cell.ends || !are_known[k];
    }
    return cell;
  }
};

/// Half way to each neighbour, but those beyond a ridge, and at ridges.
Cell cell_of(const CloudPoints& cloud, std::size_t point) {
  const CloudPoint& own = cloud.points[point];
  const TangentAxes axes = axes_across(own.normal);
  Borders borders;
  const auto end = [&](const Vec3& to, double share) {
    const double x = dot(to, axes.u) / own.spacing, y = dot(to, axes.v) / own.spacing;
    const double distance = std::hypot(x, y);
    if (distance > 0) borders.end(x / distance, y / distance, share * distance);
  };
  const bool has_ridge = length(own.ridges[0]) > 0;
  for (const std::uint32_t other : cloud.around.of(point)) {
    const double same = dot(own.normal, cloud.points[other].normal);
    if (cloud.are_apart(point, other, same, opposite)) continue;
    const bool is_beyond = cloud.is_beyond_ridge(point, other) ||
                           (has_ridge && cloud.are_apart(point, other, same, ridge_cosine));
    end(cloud.place(other) - cloud.place(point), is_beyond ? INFINITY : 0.5);
  }
  for (const Vec3& ridge : own.ridges) end(ridge, 1);
  return borders.cell();
}

/// Whether a surface ends at a point or so near that its basis function reaches over the edge.
bool is_beside_edge(const CloudPoints& cloud, const std::vector<std::uint8_t>& is_edge,
                    std::size_t point) {
  if (is_edge[point]) return true;
  const auto around = cloud.around.of(point);
  return std::any_of(around.begin(), around.end(), [&](std::uint32_t other) {
    return is_edge[other] && length(cloud.place(other) - cloud.place(point)) <
                                 beside_edge * cloud.points[point].spacing;
  });
}

/// Share of a basis function's reach where there is a surface, from where the neighbours lie.
double covered_share(const CloudPoints& cloud, std::size_t point) {
  const auto around = cloud.around.of(point);
  Vec3 mean{};
  double farthest = 0;
  for (const std::uint32_t i : around) {
    const Vec3 d = cloud.place(i) - cloud.place(point);
    mean = mean + d;
    farthest = std::max(farthest, length(d));
  }
  if (!(farthest > 0)) return 1;
  // Along the surface: over a tip all neighbours lie on one side of it.
  const Vec3& normal = cloud.points[point].normal;
  mean = mean - normal * dot(mean, normal);
  const double offset = length(mean) / static_cast<double>(around.size()) / farthest;
  return 1 - 0.5 * std::clamp((offset - inner_offset) / (edge_offset - inner_offset), 0.0, 1.0);
}

std::vector<std::uint8_t> find_edges(const CloudPoints& cloud, const std::vector<Cell>& cells) {
  std::vector<std::uint8_t> is_edge(cells.size());
  parallel_for_each(cells.size(), [&](std::size_t i) {
    const auto around = cloud.around.of(i);
    const auto others = std::count_if(around.begin(), around.end(),
                                      [&](std::uint32_t other) { return cells[other].ends; });
    is_edge[i] = cells[i].ends &&
                 static_cast<std::size_t>(others) >= std::min(others_at_edges, around.size());
  });
  return is_edge;
}

}  // namespace

TangentAxes axes_across(const Vec3& normal) {
  const Vec3 u =
      normalized(cross(normal, std::abs(normal.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  return {u, cross(normal, u)};
}

const std::array<Direction, site_count>& site_directions() {
  static const auto all = directions_around<site_count>();
  return all;
}

void find_cells(CloudPoints& cloud, const std::vector<std::uint8_t>& has_radius) {
  const std::size_t count = cloud.points.size();
  std::vector<Cell> cells(count);
  parallel_for_each(count, [&](std::size_t i) { cells[i] = cell_of(cloud, i); });
  const std::vector<std::uint8_t> is_edge = find_edges(cloud, cells);
  std::vector<double> spacings(count);
  parallel_for_each(count, [&](std::size_t i) {
    CloudPoint& p = cloud.points[i];
    // Where a closed surface ends there is a hole in the scan: gaps like others.
    const bool is_closed = cloud.is_closed && !p.is_two_sided;
    const bool is_beside = !is_closed && is_beside_edge(cloud, is_edge, i);
    p.covered = is_beside ? covered_share(cloud, i) : 1;
    const double farthest =
        is_closed && cells[i].ends ? widest_cell : static_cast<double>(cells[i].farthest);
    const double grown = is_beside || has_radius[i] ? 1 : std::max(1.0, farthest);
    const double most = p.covered < 1 || has_radius[i] ? near_reach : most_reach;
    for (std::size_t k = 0; k < site_count; ++k) {
      const double border = beyond_border * static_cast<double>(cells[i].border[k]);
      p.sites[k] = static_cast<float>(std::min(border, most) / grown);
    }
    spacings[i] = p.spacing * grown;
  });
  for (std::size_t i = 0; i < count; ++i) cloud.points[i].spacing = spacings[i];
}

}  // namespace defray
