#include "lens/aperture_mask.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/plane.h"
#include "lens/aperture_picture.h"
#include "lens/iris.h"

namespace defray {
namespace {

constexpr int mask_side = ApertureMask::side;
constexpr int points = 8;  // a side of a texel
constexpr double texel = 2.0 / mask_side;

/// The iris pressed from its sides (squeeze > 1) or from above and below.
class Shape {
 public:
  explicit Shape(const Aperture& a)
      : iris_(a), to_iris_u_(std::max(a.squeeze, 1.0)), to_iris_v_(std::max(1 / a.squeeze, 1.0)) {}

  double beyond_edge(double u, double v) const {
    return iris_.beyond_edge(u * to_iris_u_, v * to_iris_v_);
  }

  /// Open share of the texel around (u, v), 0...1.
  double open_share(double u, double v) const {
    const double half_diagonal = texel * std::numbers::sqrt2 / 2;
    const double beyond = beyond_edge(u, v);
    const double nearby = Iris::steepest * half_diagonal * std::max(to_iris_u_, to_iris_v_);
    if (std::fabs(beyond) > nearby) return beyond < 0 ? 1 : 0;
    int open = 0;
    for (int j = 0; j < points; ++j) {
      for (int i = 0; i < points; ++i) {
        open += beyond_edge(u + offset(i), v + offset(j)) <= 0 ? 1 : 0;
      }
    }
    return static_cast<double>(open) / (points * points);
  }

 private:
  static double offset(int i) { return texel * ((i + 0.5) / points - 0.5); }

  Iris iris_;
  double to_iris_u_, to_iris_v_;
};

}  // namespace

ApertureMask rasterise(const Aperture& aperture) {
  validate(aperture);
  if (!aperture.image.empty()) return rasterise_picture(aperture);
  const Shape shape(aperture);
  ApertureMask mask;
  mask.coverage.resize(mask_side * mask_side);
  parallel_for(mask_side, [&](int row) {
    for (int column = 0; column < mask_side; ++column) {
      const double open = shape.open_share((column + 0.5) * texel - 1, (row + 0.5) * texel - 1);
      mask.coverage[size(row * mask_side + column)] =
          static_cast<std::uint8_t>(std::lround(255 * open));
    }
  });
  return mask;
}

}  // namespace defray
