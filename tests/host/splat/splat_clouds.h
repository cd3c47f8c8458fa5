#pragma once
// What tests of points share.
#include <cmath>

#include "defray/splat.h"
#include "kernels/splat_params.h"

namespace defray::test {

/// Points of a plane z = x / 2, 0.1 apart along x and y.
inline PointCloud slope(int side) {
  PointCloud cloud;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      cloud.positions.push_back({0.1f * float(i), 0.1f * float(j), 0.05f * float(i)});
    }
  }
  return cloud;
}

inline double area_of(const DefraySplatNode& n) { return std::hypot(n.area_x, n.area_y, n.area_z); }

}  // namespace defray::test
