#pragma once
// What tests of point clouds share.
#include <algorithm>
#include <cmath>

#include "splat/hierarchy.h"
#include "splat/splat_picture.h"
#include "splat/splats.h"
#include "splat/surfels/surfels.h"
#include "splat/view.h"
#include "support.h"

namespace defray::test {

/// A square camera on the z axis, which looks at the origin and is focused on it.
inline DefraySplatParams view_of(int side, double distance, double aperture_mm,
                                 const SplatSettings& given = {}) {
  CameraPose pose;
  pose.from = {0, 0, distance};
  Lens lens;
  lens.aperture_diameter_mm = aperture_mm;
  lens.focus_distance_units = distance;
  SplatSettings settings = given;
  settings.width = settings.height = side;
  DefraySplatParams p = splat_params(pose, {}, lens, settings);
  p.one_sided = 1;
  return p;
}

inline Hierarchy tree_of(const PointCloud& cloud) {
  Surfels surfels = make_surfels(cloud);
  return build_hierarchy(std::move(surfels.points), std::move(surfels.ridges));
}

/// A square grid that faces the camera, of one colour; `half` is half its side.
inline PointCloud wall(int side, double half, double z, const std::array<float, 3>& colour,
                       float alpha = 1) {
  PointCloud cloud;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      cloud.positions.push_back({static_cast<float>(half * (2 * (i + 0.5) / side - 1)),
                                 static_cast<float>(half * (2 * (j + 0.5) / side - 1)),
                                 static_cast<float>(z)});
      cloud.normals.push_back({0, 0, 1});
      cloud.colours.push_back(colour);
      cloud.alpha.push_back(alpha);
    }
  }
  return cloud;
}

inline PointCloud both(PointCloud a, const PointCloud& b) {
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  a.colours.insert(a.colours.end(), b.colours.begin(), b.colours.end());
  a.alpha.insert(a.alpha.end(), b.alpha.begin(), b.alpha.end());
  return a;
}

inline SplatPlanes draw(const Hierarchy& tree, const DefraySplatParams& p, bool lod = true) {
  SplatReport ignored;
  return draw_splats(device(), tree, p, lod, 0, ignored);
}

/// The least and the largest value of a square about the middle.
inline std::pair<float, float> range_inside(const Plane& plane, int side, int half) {
  float least = 1e9f, most = -1e9f;
  for (int y = side / 2 - half; y < side / 2 + half; ++y) {
    for (int x = side / 2 - half; x < side / 2 + half; ++x) {
      least = std::min(least, plane[size(y * side + x)]);
      most = std::max(most, plane[size(y * side + x)]);
    }
  }
  return {least, most};
}

/// A surfel of a cloud, area and variance given.
inline DefraySplatNode surfel(double x, double y, double z, std::array<double, 3> area,
                              double variance) {
  DefraySplatNode n{};
  n.x = static_cast<float>(x);
  n.y = static_cast<float>(y);
  n.z = static_cast<float>(z);
  n.area_x = static_cast<float>(area[0]);
  n.area_y = static_cast<float>(area[1]);
  n.area_z = static_cast<float>(area[2]);
  n.variance = static_cast<float>(variance);
  n.cover = 1;
  n.r = n.g = n.b = n.a = 1;
  return n;
}

inline DefraySplat project(const DefraySplatNode& node, const DefraySplatParams& p) {
  const Splats splats = device().splat_project({node}, {}, p);
  EXPECT_EQ(splats.all.size(), 1u);
  return splats.all.front();
}

inline bool is_culled(const DefraySplat& s) { return s.first_x == s.end_x && s.first_y == s.end_y; }

}  // namespace defray::test
