#pragma once
// The levels of detail of a point cloud: a tree of nodes that stand for all points below them
// (QSplat: Rusinkiewicz & Levoy 2000; Krivanek & Zara 2003, section 5.3).
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/splat_params.h"

namespace defray {

struct HierarchyNode {
  DefraySplatNode splat;       ///< What it is drawn as.
  float radius;                ///< Of a sphere around its place that holds all its points.
  float whole_area;            ///< Of its points; the splat's is as long where they are flat.
  std::uint32_t is_one_sheet;  ///< Its points do not lie behind each other, nor differ in sides.
  std::uint32_t first_point, end_point;
  std::uint32_t next;  ///< The node after all that is below this one.
};

/// Nodes in the order in which they are met from the root down, `next` beside; a leaf's is the node
/// after it.
struct Hierarchy {
  std::vector<DefraySplatNode> points;  ///< In the order of the leaves.
  std::vector<HierarchyNode> nodes;
  std::vector<DefraySplatRidge> ridges;  ///< In sets of DEFRAY_SPLAT_RIDGES, as points name them.

  bool is_leaf(std::uint32_t node) const { return nodes[node].next == node + 1; }
};

/// Halves the points along the longest side of the box around them, until few are left. Areas of
/// surfaces with one side are added up as they are, others by the side that they show.
Hierarchy build_hierarchy(std::vector<DefraySplatNode> points,
                          std::vector<DefraySplatRidge> ridges = {});

}  // namespace defray
