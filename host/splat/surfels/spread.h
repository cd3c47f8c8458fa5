#pragma once
// How places lie.
#include <array>
#include <span>

#include "base/vec3.h"

namespace defray {

/// Of places: along unit axes, the largest variance first.
struct Spread {
  Vec3 mean;
  std::array<double, 3> variances;
  std::array<Vec3, 3> axes;

  /// Of their variance the share along the last axis, 0 to 1/3; 0 if all are in one place.
  double thickness() const {
    const double all = variances[0] + variances[1] + variances[2];
    return all > 0 ? variances[2] / all : 0;
  }
};

/// Of one place or more.
Spread spread_of(std::span<const Vec3> places);

}  // namespace defray
