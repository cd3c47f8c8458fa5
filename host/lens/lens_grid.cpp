#include "lens/lens_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/error.h"
#include "kernels/params.h"

namespace defray {

LensPoints make_lens_grid(int cells_per_side, bool jitter) {
  if (cells_per_side < 1 || cells_per_side > 64) {
    fail(ErrorKind::usage, "{} is {}: allowed are 1 to 64 cells a side", field("cells_per_side"),
         cells_per_side);
  }
  constexpr std::int64_t radius = 1 << DEFRAY_LENS_FRACTION_BITS;
  const auto centre = [&](int i) {
    return static_cast<std::int32_t>(
        std::lround(static_cast<double>(radius) * (2 * i + 1 - cells_per_side) / cells_per_side));
  };
  LensPoints lens;
  if (jitter) lens.jitter = static_cast<std::int32_t>(radius / cells_per_side);
  const auto nearest_to_axis = [&](std::int32_t u) {
    return std::max<std::int64_t>(0, std::abs(u) - lens.jitter);
  };
  for (int j = 0; j < cells_per_side; ++j) {
    for (int i = 0; i < cells_per_side; ++i) {
      const std::int64_t u = nearest_to_axis(centre(i));
      const std::int64_t v = nearest_to_axis(centre(j));
      if (u * u + v * v <= radius * radius) lens.points.push_back({centre(i), centre(j)});
    }
  }
  return lens;
}

int round_cells(int cells_per_side) {
  return static_cast<int>(make_lens_grid(cells_per_side, false).points.size());
}

float cells_per_side(int lens_points) {
  return static_cast<float>(std::sqrt(lens_points * 4 / std::numbers::pi));
}

}  // namespace defray
