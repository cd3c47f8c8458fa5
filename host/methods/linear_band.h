#pragma once
// What `linear` prepares on the host: discs' sums, and source planes with a border around them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "frame/band_rows.h"
#include "kernels/params.h"

namespace defray {

/// Sums of the soft disc clamp(r + 1/2 - d, 0, 1) over all pixels, for any radius up to a largest:
/// from the number of pixels at each squared distance, and the sum of their distances.
class DiscNorms {
 public:
  explicit DiscNorms(int reach);
  double operator()(double radius) const;

 private:
  std::vector<double> count_, distance_;  // up to this squared distance
};

/// One band's source planes with the frame's edge pixels repeated around them.
class PaddedBand {
 public:
  PaddedBand(int width, int height, const BandRows& band, int reach)
      : width_(width), height_(height), first_(band.y - reach), reach_(reach) {
    stride = stride_for(width, reach);
    rows = size(band.rows + 2 * reach);
  }

  /// Floats in a row: reach on both sides, and whole runs from the first target pixel on.
  static std::size_t stride_for(int width, int reach) {
    return target_stride_for(width) + 2 * size(reach);
  }
  static std::size_t target_stride_for(int width) {
    constexpr std::size_t run = DEFRAY_LINEAR_RUN;
    return (size(width) + run - 1) / run * run;
  }

  /// `value(i)` is the plane's value at frame index i.
  template <typename Value>
  Plane plane(const Value& value) const {
    Plane out(rows * stride);
    for (std::size_t row = 0; row < rows; ++row) {
      const int y = std::clamp(first_ + static_cast<int>(row), 0, height_ - 1);
      const std::size_t line = size(y) * size(width_);
      for (std::size_t column = 0; column < stride; ++column) {
        const int x = std::clamp(static_cast<int>(column) - reach_, 0, width_ - 1);
        out[row * stride + column] = value(line + size(x));
      }
    }
    return out;
  }

  std::size_t stride, rows;

 private:
  int width_, height_, first_, reach_;
};

/// Bands whose planes fit the memory. Throws Error(usage) if not even one row's do.
std::vector<BandRows> linear_bands(int width, int height, int reach, std::size_t memory_bytes);

/// Reach of each row of a padded band.
std::vector<std::int32_t> row_reaches(const Plane& radius, const PaddedBand& band);

}  // namespace defray
