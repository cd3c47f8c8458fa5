#include "splat/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <span>

#include "base/vec3.h"
#include "splat/surfels/cloud_points.h"

namespace defray {
namespace {

/// Fewer points than this are one leaf.
constexpr std::uint32_t leaf_points = 5;
/// So many halves are each built in a thread of their own.
constexpr int parallel_levels = 3;

Vec3 place_of(const DefraySplatNode& n) { return {n.x, n.y, n.z}; }
Vec3 area_of(const DefraySplatNode& n) { return {n.area_x, n.area_y, n.area_z}; }

float along(const DefraySplatNode& n, int axis) { return axis == 0 ? n.x : axis == 1 ? n.y : n.z; }

/// By one coordinate; equal ones by the others, so that any library's order is ours.
bool is_before(const DefraySplatNode& a, const DefraySplatNode& b, int axis) {
  for (int i = 0; i < 3; ++i) {
    const float p = along(a, (axis + i) % 3), q = along(b, (axis + i) % 3);
    if (p != q) return p < q;
  }
  return false;
}

/// Sums over points from which a node follows.
struct Moments {
  double area = 0;
  Vec3 spanned{}, place{};
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double variance = 0, cover = 0, both_sides = 0, r = 0, g = 0, b = 0, a = 0;

  /// Places from `origin`; `whole` is the area, of which `spanned` is what shows.
  void add(const DefraySplatNode& n, double whole, const Vec3& origin) {
    const Vec3 p = place_of(n) - origin;
    const double side = n.both_sides > 0.5f && dot(spanned, area_of(n)) < 0 ? -1 : 1;
    area += whole;
    spanned = spanned + area_of(n) * side;
    place = place + p * whole;
    xx += whole * (p.x * p.x + n.low_xx);
    xy += whole * (p.x * p.y + n.low_xy);
    xz += whole * (p.x * p.z + n.low_xz);
    yy += whole * (p.y * p.y + n.low_yy);
    yz += whole * (p.y * p.z + n.low_yz);
    zz += whole * (p.z * p.z + n.low_zz);
    variance += whole * n.variance;
    cover += whole * n.cover;
    both_sides += whole * n.both_sides;
    r += whole * n.r;
    g += whole * n.g;
    b += whole * n.b;
    a += whole * n.a;
  }

  DefraySplatNode node(const Vec3& origin) const {
    const Vec3 mean = place / area, at = mean + origin;
    const auto covariance = [&](double sum, double p, double q) {
      return static_cast<float>(sum / area - p * q);
    };
    return {static_cast<float>(at.x),
            static_cast<float>(at.y),
            static_cast<float>(at.z),
            static_cast<float>(spanned.x),
            static_cast<float>(spanned.y),
            static_cast<float>(spanned.z),
            static_cast<float>(variance / area),
            covariance(xx, mean.x, mean.x),
            covariance(xy, mean.x, mean.y),
            covariance(xz, mean.x, mean.z),
            covariance(yy, mean.y, mean.y),
            covariance(yz, mean.y, mean.z),
            covariance(zz, mean.z, mean.z),
            static_cast<float>(cover / area),
            static_cast<float>(both_sides / area),
            static_cast<float>(r / area),
            static_cast<float>(g / area),
            static_cast<float>(b / area),
            static_cast<float>(a / area),
            0};
  }
};

/// Two sheets behind each other have twice the area of what their places lie in, and where they are
/// narrow, or one has few of the points, are thick beside that. A cap of a sphere as wide as
/// cut.cpp lets one node stand for has 0.02.
constexpr double most_sheets = 1.5, most_thickness = 0.03;
/// Of a node whose points have one side this share may have two, or the other way round.
constexpr float most_other_sides = 0.1f;

/// Whether a node's points, of so much area in all, lie on one sheet that shows as many sides, by
/// the covariance of their places. Each stands for a square of its own.
bool is_one_sheet(const DefraySplatNode& n, double area) {
  if (std::min(n.both_sides, 1 - n.both_sides) > most_other_sides) return false;
  const double own = n.variance / (12 * basis_deviation * basis_deviation);
  const double xx = n.low_xx + own, yy = n.low_yy + own, zz = n.low_zz + own;
  const double xy = n.low_xy, xz = n.low_xz, yz = n.low_yz;
  const auto between = [](const Vec3& v, const Vec3& x, const Vec3& y, const Vec3& z) {
    return v.x * dot(v, x) + v.y * dot(v, y) + v.z * dot(v, z);
  };
  const Vec3 normal = normalized(area_of(n));
  const double thickness = between(normal, {xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}) - own;
  // Across the normal: by the adjugate.
  const double determinant =
      between(normal, {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy},
              {xz * yz - xy * zz, xx * zz - xz * xz, xy * xz - xx * yz},
              {xy * yz - xz * yy, xy * xz - xx * yz, xx * yy - xy * xy});
  // A rectangle's, as of all that kd-trees have.
  const double rectangle = 12 * std::sqrt(std::max(determinant, 0.0));
  return area <= most_sheets * rectangle &&
         thickness <= most_thickness * (xx + yy + zz - thickness);
}

/// What is the same of leaves and of what is above them.
void set_node(const Moments& sum, const Vec3& origin, HierarchyNode& made) {
  made.splat = sum.node(origin);
  made.whole_area = static_cast<float>(sum.area);
  made.is_one_sheet = is_one_sheet(made.splat, sum.area);
}

/// How many nodes there are above so many points.
std::uint32_t nodes_above(std::uint32_t points) {
  if (points < leaf_points) return 1;
  const std::uint32_t half = points / 2;
  const std::uint32_t first = nodes_above(half);
  return 1 + first + (points - half == half ? first : nodes_above(points - half));
}

class Builder {
 public:
  explicit Builder(Hierarchy& tree) : tree_(tree) {}

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t end, int level) {
    HierarchyNode& made = tree_.nodes[node];
    made.first_point = first;
    made.end_point = end;
    made.next = node + nodes_above(end - first);
    if (end - first < leaf_points) {
      finish(made, std::span(tree_.points).subspan(first, end - first));
      return;
    }
    const std::uint32_t middle = first + (end - first) / 2;
    halve(first, middle, end);
    const std::uint32_t left = node + 1, right = left + nodes_above(middle - first);
    if (level < parallel_levels) {
      const auto other =
          std::async(std::launch::async, [=, this] { build(left, first, middle, level + 1); });
      build(right, middle, end, level + 1);
      other.wait();
    } else {
      build(left, first, middle, level + 1);
      build(right, middle, end, level + 1);
    }
    join(made, tree_.nodes[left], tree_.nodes[right]);
  }

 private:
  void halve(std::uint32_t first, std::uint32_t middle, std::uint32_t end) {
    const auto begin = tree_.points.begin();
    const std::span<const DefraySplatNode> part =
        std::span(tree_.points).subspan(first, end - first);
    int axis = 0;
    float longest = -1;
    for (int i = 0; i < 3; ++i) {
      const auto [least, most] = std::minmax_element(
          part.begin(), part.end(),
          [i](const auto& a, const auto& b) { return along(a, i) < along(b, i); });
      const float side = along(*most, i) - along(*least, i);
      if (side > longest) {
        longest = side;
        axis = i;
      }
    }
    std::nth_element(begin + first, begin + middle, begin + end,
                     [axis](const auto& a, const auto& b) { return is_before(a, b, axis); });
  }

  void finish(HierarchyNode& made, std::span<DefraySplatNode> points) const {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return is_before(a, b, 0); });
    const Vec3 origin = place_of(points.front());
    Moments sum;
    for (const DefraySplatNode& p : points) sum.add(p, length(area_of(p)), origin);
    set_node(sum, origin, made);
    double radius = 0;
    for (const DefraySplatNode& p : points) {
      radius = std::max(radius, length(place_of(p) - place_of(made.splat)));
    }
    made.radius = static_cast<float>(radius);
  }

  void join(HierarchyNode& made, const HierarchyNode& left, const HierarchyNode& right) const {
    const Vec3 origin = place_of(left.splat);
    Moments sum;
    for (const HierarchyNode* child : {&left, &right}) {
      sum.add(child->splat, static_cast<double>(child->whole_area), origin);
    }
    set_node(sum, origin, made);
    double radius = 0;
    for (const HierarchyNode* child : {&left, &right}) {
      radius = std::max(radius, length(place_of(child->splat) - place_of(made.splat)) +
                                    static_cast<double>(child->radius));
    }
    made.radius = static_cast<float>(radius);
  }

  Hierarchy& tree_;
};

}  // namespace

Hierarchy build_hierarchy(std::vector<DefraySplatNode> points,
                          std::vector<DefraySplatRidge> ridges) {
  Hierarchy tree;
  tree.points = std::move(points);
  tree.ridges = std::move(ridges);
  const auto count = static_cast<std::uint32_t>(tree.points.size());
  tree.nodes.resize(nodes_above(count));
  Builder(tree).build(0, 0, count, 0);
  return tree;
}

}  // namespace defray
