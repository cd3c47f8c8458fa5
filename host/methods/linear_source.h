#pragma once
// What `linear` prepares on the host: discs' sums, and source planes with a border beside them.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/frame.h"

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

/// Planes of a window: rows of `stride` values, which begin `reach` columns left of the frame.
/// Beside it its edge pixels repeat.
struct LinearSource {
  LinearSource(const Frame& frame, const BandRows& rows, int reach, std::size_t stride,
               const DiscNorms& norm);

  Plane radius;                         ///< |CoC|, px.
  std::vector<Plane> scaled;            ///< Colours, each over twice its disc's sum.
  std::vector<std::int32_t> row_reach;  ///< Of each row, whole px.
};

}  // namespace defray
