#include "lens/lens_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "kernels/params.h"
#include "lens/aperture.h"
#include "lens/aperture_mask.h"
#include "lens/iris.h"

namespace defray {
namespace {

constexpr int mask_side = ApertureMask::side;

std::array<std::int32_t, 2> to_lens(double u, double v) {
  constexpr double radius = 1 << DEFRAY_LENS_FRACTION_BITS;
  return {static_cast<std::int32_t>(std::lround(radius * u)),
          static_cast<std::int32_t>(std::lround(radius * v))};
}

LensPoints sample_iris(const Aperture& a, int count) {
  // 1 - 1/phi of a turn is the golden angle; two arms take half of it.
  constexpr double turn = (2 - std::numbers::phi) / 2;
  const double scale_u = std::min(1.0, 1 / a.squeeze), scale_v = std::min(1.0, a.squeeze);
  const Iris iris(a);
  LensPoints lens;
  const int centre = count % 2;
  if (centre) lens.points.push_back({0, 0});
  for (int k = 0; k < count / 2; ++k) {
    const double way = std::sqrt((2.0 * k + 1 + centre) / count);
    for (const double arm : {0.0, 0.5}) {
      const double share = k * turn + arm;
      const Iris::Edge edge = iris.edge_at_share(share - std::floor(share));
      const double r = way * edge.radius;
      lens.points.push_back(
          to_lens(scale_u * r * std::cos(edge.angle), scale_v * r * std::sin(edge.angle)));
    }
  }
  return lens;
}

/// Where, 0...side, light has come to this share of its sum along a row of texels.
double place_of_share(const std::vector<double>& light, double share) {
  double sum = 0;
  for (const double l : light) sum += l;
  double left = share * sum;
  std::size_t i = 0;
  while (i + 1 < light.size() && left >= light[i]) left -= light[i++];
  return static_cast<double>(i) + (light[i] > 0 ? std::min(1.0, left / light[i]) : 0);
}

LensPoints sample_picture(const ApertureMask& mask, int count) {
  std::vector<double> of_columns(mask_side);
  for (std::size_t i = 0; i < mask.coverage.size(); ++i)
    of_columns[i % mask_side] += mask.coverage[i];
  LensPoints lens;
  for (int k = 0; k < count; ++k) {
    const double u = place_of_share(of_columns, (k + 0.5) / count);
    std::vector<double> of_column;
    const int column = std::min(static_cast<int>(u), mask_side - 1);
    for (int row = 0; row < mask_side; ++row) of_column.push_back(mask.at(column, row));
    // Counted from the middle one on: a lattice that half a turn maps to itself.
    const double turns = (k - (count - 1) / 2.0) * std::numbers::phi + 0.5;
    const double v = place_of_share(of_column, turns - std::floor(turns));
    lens.points.push_back(to_lens(2 * u / mask_side - 1, 2 * v / mask_side - 1));
  }
  return lens;
}

}  // namespace

LensPoints make_lens_points(const Aperture& aperture, int count) {
  validate(aperture);
  if (count < 1 || count > most_lens_points) {
    fail(ErrorKind::usage, "lens points: {} asked for, allowed are 1 to {}", count,
         most_lens_points);
  }
  if (aperture.image.empty()) return sample_iris(aperture, count);
  return sample_picture(rasterise(aperture), count);
}

}  // namespace defray
