#include "splat/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/plane.h"
#include "base/vec3.h"
#include "splat/view.h"

namespace defray {
namespace {

// How wide a node may be in the picture: so many pixels, or, with its points' own size, so many
// radii of its CoC; 1 + narrower_in_lens times less where the lens's radius is the distance,
// because nodes look narrower or wider from its sides than from its centre. Weights of even balls
// (2000 to 300 000 points, lenses up to three times as wide) are then no less than 0.990; with 1.4
// radii 0.975, with all lenses alike 0.96; with 1 radius 0.996, but `figure` takes longer at 1600
// mm than sharp.
constexpr double widest_px = 1, widest_in_blur = 1.15, narrower_in_lens = 2;
/// Areas of a node's points that point apart by more than this hide each other.
constexpr double least_coherence = 0.9;

/// A node as the camera sees it.
struct SeenNode {
  double x, y, z, radius;
};

class View {
 public:
  explicit View(const DefraySplatParams& p)
      : p_(p),
        sides_{Side(p, p.centre_x), Side(p, p.width - p.centre_x), Side(p, p.centre_y),
               Side(p, p.height - p.centre_y)} {}

  SeenNode see(const HierarchyNode& n) const {
    const Vec3 at = Vec3{n.splat.x, n.splat.y, n.splat.z} - Vec3{p_.eye_x, p_.eye_y, p_.eye_z};
    const double basis = std::sqrt(2.0 * p_.cutoff * n.splat.variance);
    return {dot(at, {p_.right_x, p_.right_y, p_.right_z}),
            dot(at, {p_.down_x, p_.down_y, p_.down_z}),
            dot(at, {p_.forward_x, p_.forward_y, p_.forward_z}), n.radius + basis};
  }

  /// Whether none of it can reach the picture.
  bool is_outside(const SeenNode& s) const {
    const double near = s.z - s.radius, far = s.z + s.radius;
    if (far <= p_.near_units) return true;
    const double nearest = std::max(near, static_cast<double>(p_.near_units));
    // A kernel's reach is that of its Gaussian: 1.34 CoC radii at c = 2.5.
    const double coc =
        std::max(std::abs(splat_coc_px(p_, nearest)), std::abs(splat_coc_px(p_, far)));
    const double margin = coc * std::max(1.0, 0.6005612 * std::sqrt(2.0 * p_.cutoff)) +
                          2 * std::sqrt(2.0 * p_.cutoff);
    const double left = p_.centre_x, top = p_.centre_y;
    return is_beside(-s.x, s, left + margin) || is_beside(s.x, s, p_.width - left + margin) ||
           is_beside(-s.y, s, top + margin) || is_beside(s.y, s, p_.height - top + margin);
  }

  /// Whether all of it is in the picture: then so is all below it, which need not be asked.
  bool is_inside(const SeenNode& s) const {
    return s.z - s.radius > p_.near_units && sides_[0].holds(-s.x, s) && sides_[1].holds(s.x, s) &&
           sides_[2].holds(-s.y, s) && sides_[3].holds(s.y, s);
  }

  bool is_small(const SeenNode& s, const HierarchyNode& n) const {
    const double near = s.z - s.radius;
    if (!(near > p_.near_units)) return false;
    const double px = p_.focal_px / near, own = std::sqrt(static_cast<double>(n.splat.variance));
    return (2.0 * n.radius * px <= widest_px ||
            is_small_in_blur(2.0 * (n.radius + own) * px, near, s.z + s.radius)) &&
           is_coherent(n);
  }

 private:
  bool is_small_in_blur(double width_px, double near, double far) const {
    const double here = splat_coc_px(p_, near), there = splat_coc_px(p_, far);
    if ((here < 0) != (there < 0)) return false;  // some of it is in focus
    const double blur = std::min(std::abs(here), std::abs(there));
    const double lens = p_.lens_units / near;
    return width_px * (1 + narrower_in_lens * lens * lens) <= widest_in_blur * blur;
  }

  static bool is_coherent(const HierarchyNode& n) {
    const double spanned = length({n.splat.area_x, n.splat.area_y, n.splat.area_z});
    return spanned >= least_coherence * static_cast<double>(n.whole_area) && n.is_one_sheet;
  }

  /// The plane through the eye and a side of the picture, `edge` px from the axis.
  struct Side {
    double focal, edge, slant;

    Side(const DefraySplatParams& p, double edge_px)
        : focal(p.focal_px), edge(edge_px), slant(std::sqrt(focal * focal + edge * edge)) {}

    bool holds(double off_axis, const SeenNode& s) const {
      return off_axis * focal - s.z * edge < -s.radius * slant;
    }
  };

  /// Beyond the plane through the eye and a line in the picture, `edge` px from the axis.
  bool is_beside(double off_axis, const SeenNode& s, double edge) const {
    const double focal = p_.focal_px;
    return off_axis * focal - s.z * edge > s.radius * std::sqrt(focal * focal + edge * edge);
  }

  const DefraySplatParams& p_;
  const std::array<Side, 4> sides_;
};

/// So many halvings down the parts begin that threads take: 64 parts.
constexpr int levels_above_parts = 6;

using NodeSpan = std::span<const DefraySplatNode>;

/// A part of the hierarchy and what is drawn of it.
struct Part {
  std::uint32_t first, end;  ///< Nodes.
  std::vector<NodeSpan> cut;
  std::size_t count = 0;  ///< In all of them.

  void add(NodeSpan nodes) {
    cut.push_back(nodes);
    count += nodes.size();
  }
};

class Cut {
 public:
  Cut(const Hierarchy& tree, const DefraySplatParams& view, bool lod)
      : tree_(tree), camera_(view), lod_(lod) {}

  /// In the hierarchy's order.
  void collect(std::uint32_t node, int levels, std::vector<Part>& parts) const {
    const HierarchyNode& n = tree_.nodes[node];
    const SeenNode seen = camera_.see(n);
    if (camera_.is_outside(seen)) return;
    if (levels == 0 || tree_.is_leaf(node) || stands_for_all(seen, n)) {
      parts.push_back({node, n.next, {}, 0});
      return;
    }
    collect(node + 1, levels - 1, parts);
    collect(tree_.nodes[node + 1].next, levels - 1, parts);
  }

  void draw(Part& part) const {
    std::uint32_t inside_end = part.first;  // nodes before it are known to be in the picture
    for (std::uint32_t i = part.first; i < part.end;) {
      const HierarchyNode& node = tree_.nodes[i];
      const SeenNode seen = camera_.see(node);
      if (i >= inside_end && camera_.is_outside(seen)) {
        i = node.next;
        continue;
      }
      if (i >= inside_end && camera_.is_inside(seen)) inside_end = node.next;
      if (stands_for_all(seen, node)) {
        part.add({&node.splat, 1});
        i = node.next;
      } else if (tree_.is_leaf(i)) {
        part.add(
            NodeSpan(tree_.points).subspan(node.first_point, node.end_point - node.first_point));
        i = node.next;
      } else {
        ++i;
      }
    }
  }

 private:
  bool stands_for_all(const SeenNode& seen, const HierarchyNode& node) const {
    return lod_ && camera_.is_small(seen, node);
  }

  const Hierarchy& tree_;
  const View camera_;
  const bool lod_;
};

}  // namespace

Values<DefraySplatNode> cut_hierarchy(const Hierarchy& tree, const DefraySplatParams& view,
                                      bool lod) {
  const Cut cut(tree, view, lod);
  std::vector<Part> parts;
  if (!tree.nodes.empty()) cut.collect(0, levels_above_parts, parts);
  const int count = static_cast<int>(parts.size());
  parallel_for(count, [&](int i) { cut.draw(parts[size(i)]); });
  std::vector<std::size_t> place;
  std::size_t all = 0;
  for (const Part& part : parts) {
    place.push_back(all);
    all += part.count;
  }
  auto nodes = Values<DefraySplatNode>::room(all);
  const std::span<DefraySplatNode> to = nodes.edit();
  parallel_for(count, [&](int i) {
    auto at = to.begin() + static_cast<std::ptrdiff_t>(place[size(i)]);
    for (const NodeSpan part : parts[size(i)].cut) at = std::copy(part.begin(), part.end(), at);
  });
  return nodes;
}

}  // namespace defray
