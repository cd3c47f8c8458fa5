#pragma once
// Points made ready to be splatted: each stands for a piece of surface, with a normal, an area and
// the width of its basis function.
#include <string>
#include <vector>

#include "defray/splat.h"
#include "kernels/splat_params.h"

namespace defray {

struct Surfels {
  std::vector<DefraySplatNode> points;
  /// In sets of DEFRAY_SPLAT_RIDGES, as points name them; the first is of those without.
  std::vector<DefraySplatRidge> ridges = std::vector<DefraySplatRidge>(DEFRAY_SPLAT_RIDGES);
  bool has_normals = false;  ///< Given; else what is closed has an outside.
  bool has_colours = false;
  std::vector<std::string> notes;
};

/// Leaves out points without a finite place, or more than 20 in one, estimates what the cloud does
/// not say, and weighs the points so that their basis functions add up to 1 all over the surface
/// (Krivanek & Zara 2003, section 6.3, but on the surface itself instead of in rendered images).
/// Throws Error(input).
Surfels make_surfels(const PointCloud& cloud, const Progress& progress = {});

}  // namespace defray
