#include "splat/cut.h"

#include <algorithm>
#include <cmath>

#include "base/vec3.h"
#include "splat/view.h"

namespace defray {
namespace {

// How wide a node may be in the picture: so many pixels, or this share of its CoC's radius. Nodes
// lie about 0.7 widths apart, where Gaussians of 0.6 CoC radii then add up to 1 within 1 % (c
// = 2.5). Discs have edges, and need more of them: on `crossing` at 600 mm widths of 0.7, 0.5,
// 0.35, 0.25 are 36.2, 45.1, 45.2, 45.5 dB from every point by itself; on planes 0.5 shows steps.
constexpr double widest_px = 1, widest_gaussian = 1, widest_disc = 0.35;
/// Areas of a node's points that point apart by more than this hide each other.
constexpr double least_coherence = 0.9;

/// A node as the camera sees it.
struct SeenNode {
  double x, y, z, radius;
};

class View {
 public:
  explicit View(const DefraySplatParams& p) : p_(p) {}

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

  bool is_small(const SeenNode& s, const HierarchyNode& n) const {
    const double near = s.z - s.radius;
    if (!(near > p_.near_units)) return false;
    const double spanned = length({n.splat.area_x, n.splat.area_y, n.splat.area_z});
    if (spanned < least_coherence * static_cast<double>(n.whole_area)) return false;
    const double width_px = 2.0 * n.radius * p_.focal_px / near;
    if (width_px <= widest_px) return true;
    const double here = splat_coc_px(p_, near), there = splat_coc_px(p_, s.z + s.radius);
    if ((here < 0) != (there < 0)) return false;  // some of it is in focus
    const double blur = std::min(std::abs(here), std::abs(there));
    return width_px <= (p_.has_discs ? widest_disc : widest_gaussian) * blur;
  }

 private:
  /// Beyond the plane through the eye and a line in the picture, `edge` px from the axis.
  bool is_beside(double off_axis, const SeenNode& s, double edge) const {
    const double focal = p_.focal_px;
    return off_axis * focal - s.z * edge > s.radius * std::hypot(focal, edge);
  }

  const DefraySplatParams& p_;
};

}  // namespace

std::vector<DefraySplatNode> cut_hierarchy(const Hierarchy& tree, const DefraySplatParams& view,
                                           bool lod) {
  const View camera(view);
  std::vector<DefraySplatNode> cut;
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    const HierarchyNode& node = tree.nodes[i];
    const SeenNode seen = camera.see(node);
    if (camera.is_outside(seen)) {
      i = node.next;
    } else if (lod && camera.is_small(seen, node)) {
      cut.push_back(node.splat);
      i = node.next;
    } else if (tree.is_leaf(i)) {
      cut.insert(cut.end(), tree.points.begin() + node.first_point,
                 tree.points.begin() + node.end_point);
      i = node.next;
    } else {
      ++i;
    }
  }
  return cut;
}

}  // namespace defray
