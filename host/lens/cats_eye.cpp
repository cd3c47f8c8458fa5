#include "lens/cats_eye.h"

#include <cmath>

#include "kernels/params.h"

namespace defray {

RimCentre rim_centre(double strength, double x, double y, int width, int height) {
  constexpr double radius = 1 << DEFRAY_LENS_FRACTION_BITS;
  const double half_diagonal = std::hypot(width, height) / 2;
  const auto off = [&](double place, int extent) {
    return static_cast<std::int32_t>(
        std::lround(-strength * radius * (place - extent / 2.0) / half_diagonal));
  };
  return {off(x, width), off(y, height)};
}

bool passes_rim(const RimCentre& rim, std::int32_t u, std::int32_t v) {
  constexpr std::int64_t radius = 1 << DEFRAY_LENS_FRACTION_BITS;
  const std::int64_t du = std::int64_t{u} - rim[0], dv = std::int64_t{v} - rim[1];
  return du * du + dv * dv <= radius * radius;
}

}  // namespace defray
