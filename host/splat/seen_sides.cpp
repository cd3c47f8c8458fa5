#include "splat/seen_sides.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/plane.h"
#include "base/vec3.h"

namespace defray {
namespace {

/// The picture in this many parts along each side.
constexpr int view_cells = 32;

/// Nodes with one side whose normals point away from the camera: how many, and in each part of the
/// picture how far the nearest of them is, and of the others.
struct Sides {
  double away = 0;
  std::vector<float> away_units, towards_units;  ///< Infinite without one.

  Sides() : away_units(size(view_cells) * view_cells, INFINITY), towards_units(away_units) {}

  Sides& operator+=(const Sides& other) {
    away += other.away;
    for (std::size_t i = 0; i < away_units.size(); ++i) {
      away_units[i] = std::min(away_units[i], other.away_units[i]);
      towards_units[i] = std::min(towards_units[i], other.towards_units[i]);
    }
    return *this;
  }

  /// Where both are seen, the former lie before the latter.
  bool are_inside_out() const {
    std::ptrdiff_t before = 0, behind = 0;
    for (std::size_t i = 0; i < away_units.size(); ++i) {
      if (std::isinf(away_units[i]) || std::isinf(towards_units[i])) continue;
      ++(away_units[i] < towards_units[i] ? before : behind);
    }
    return before > behind;
  }
};

/// Which part of the picture a place is in, from the eye, `depth` away; none: nothing.
std::optional<std::size_t> view_cell(const DefraySplatParams& p, const Vec3& from_eye,
                                     double depth) {
  if (!(depth > p.near_units)) return std::nullopt;
  const double scale = p.focal_px / depth;
  const double x = p.centre_x + scale * dot(from_eye, {p.right_x, p.right_y, p.right_z});
  const double y = p.centre_y + scale * dot(from_eye, {p.down_x, p.down_y, p.down_z});
  if (!(x >= 0 && y >= 0 && x < p.width && y < p.height)) return std::nullopt;
  const auto column = static_cast<std::size_t>(x / p.width * view_cells);
  return static_cast<std::size_t>(y / p.height * view_cells) * view_cells + column;
}

Sides sides_of(const Values<DefraySplatNode>& nodes, const DefraySplatParams& p) {
  return parallel_sum(nodes.size(), [&](std::size_t first, std::size_t end) {
    Sides sides;
    for (const DefraySplatNode* n = nodes.begin() + first; n != nodes.begin() + end; ++n) {
      if (n->both_sides > 0.5f) continue;
      const Vec3 from_eye = Vec3{n->x, n->y, n->z} - Vec3{p.eye_x, p.eye_y, p.eye_z};
      const double depth = dot(from_eye, {p.forward_x, p.forward_y, p.forward_z});
      const bool is_away = dot({n->area_x, n->area_y, n->area_z}, from_eye) >= 0;
      sides.away += is_away;
      const auto cell = view_cell(p, from_eye, depth);
      if (!cell) continue;
      float& nearest = (is_away ? sides.away_units : sides.towards_units)[*cell];
      nearest = std::min(nearest, static_cast<float>(depth));
    }
    return sides;
  });
}

}  // namespace

void describe_sides(const Values<DefraySplatNode>& nodes, const DefraySplatParams& p,
                    SplatReport& report) {
  if (nodes.empty()) return;
  const Sides sides = sides_of(nodes, p);
  report.from_behind = sides.away / static_cast<double>(nodes.size());
  report.is_inside_out = sides.are_inside_out();
}

bool is_within(const Hierarchy& tree, const Vec3& place) {
  if (tree.nodes.front().splat.both_sides == 1) return false;
  const double sum = parallel_sum(tree.points.size(), [&](std::size_t first, std::size_t end) {
    double part = 0;
    for (std::size_t i = first; i < end; ++i) {
      const DefraySplatNode& n = tree.points[i];
      if (n.both_sides > 0.5f) continue;
      const Vec3 d = Vec3{n.x, n.y, n.z} - place;
      const double square = dot(d, d) + static_cast<double>(n.variance);
      part += dot({n.area_x, n.area_y, n.area_z}, d) / (square * std::sqrt(square));
    }
    return part;
  });
  return sum > 2 * M_PI;
}

}  // namespace defray
