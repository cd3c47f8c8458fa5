#pragma once
// How far two pictures are apart.
#include <vector>

#include "rdb.h"

namespace defray {

struct Comparison {
  double psnr_srgb_db = 0;    ///< Values sRGB-encoded and clipped to 0...1; infinity: equal.
  double psnr_linear_db = 0;  ///< Linear values clipped to 0...1.
  double rms = 0;             ///< Linear, nothing clipped.
  double worst = 0;           ///< Largest absolute difference, linear, nothing clipped.
  int worst_x = 0, worst_y = 0;
};

/// Compares the first three channels of two pictures of equal size.
/// Throws Error(usage) when sizes or channel counts differ.
Comparison compare(const std::vector<Plane>& a, const std::vector<Plane>& b, int width);

}  // namespace defray
