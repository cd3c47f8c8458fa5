// How far kernel coc and its twin are from the exact circle of confusion, over every magnitude of
// depth, focus and radius.
//
// A radius of 2^23 quanta or more is a float that the rounding to whole quanta leaves alone, and K
// only scales: apertures that put radii there show the float error of every depth and focus.
//
// The bound, u = 2^-24, m(x) in [1, 2) the significand of x: K, the quotient q and the product r
// are rounded once; z - hi and then - lo once each (or, near focus, where z - hi is exact, lo and
// the second difference d). A rounding of x costs r up to m(r) / (2 m(x)) of its ulps, so that
//   error <= m(r)/2 (1/m(K) + 2/m(d) + 1/m(q) + 1/m(r)),
// and m(r) is m(K) m(q) or half of it: m(r)/2 (1/m(K) + 1/m(q)) <= 3/2, together
//   3/2 + 2 + 1/2 = 4 ulp.
// A device that does not round division correctly may be 2.5 ulp off there instead of 1/2: the
// quotient's share grows from m(K)/2 to 5 m(K)/2 ulp, the bound to 8 ulp.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "numbers.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::coc_accuracy_test {
namespace {

using Exact = long double;
constexpr int width = 1920;
constexpr double limit = DEFRAY_COC_LIMIT_QUANTA;
constexpr double second_order = 1 + 1e-6;  // products of roundings

double bound_ulp() { return (session().info().rounds_divisions ? 4 : 8) * second_order; }

/// The lens in numbers without a rounding that matters.
struct ExactLens {
  Exact scale_quanta;  // K; for focus at infinity K z0
  Exact focus;         // z0, or inf

  explicit ExactLens(const Lens& lens) : focus(lens.focus_distance_units) {
    const Exact unit_mm = 1000 * Exact(lens.metres_per_unit);
    const Exact pixel_focal = width * Exact(lens.focal_length_mm) / Exact(lens.sensor_width_mm);
    scale_quanta = 128 * Exact(lens.aperture_diameter_mm) / unit_mm * pixel_focal;
    const Exact f = Exact(lens.focal_length_mm) / unit_mm;
    if (!std::isinf(focus)) {
      scale_quanta /= lens.model == LensModel::breathing ? focus - f : focus;
    }
  }
  Exact quanta(float depth) const {
    const Exact z = depth;
    if (std::isinf(focus)) return std::isinf(z) ? 0 : -scale_quanta / z;
    return std::isinf(z) ? scale_quanta : scale_quanta * ((z - focus) / z);
  }
  /// The depth of a signed radius, where there is one.
  float depth_of(Exact quanta) const {
    if (std::isinf(focus)) return static_cast<float>(scale_quanta / std::fabs(quanta));
    return static_cast<float>(std::fabs(focus / (1 - quanta / scale_quanta)));
  }
};

/// Everything random about a lens and the depths before it.
class Randomiser {
 public:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  /// A number of any significand whose binary exponent lies in this range.
  double magnitude(double from, double to) { return std::exp2(uniform(from, to)); }
  unsigned below(unsigned count) { return static_cast<unsigned>(engine_() % count); }

  double focus() {
    switch (below(8)) {
      case 0:
        return HUGE_VAL;
      case 1:
        return static_cast<float>(magnitude(-20, 100));  // no digits below a float's
      case 2:
        return static_cast<float>(magnitude(-3, 14)) * (1 + 0x1p-45);
      case 3:
        return 0.05 * (1 + magnitude(-19.9, 0));  // from f (1 + 1e-6)
      default:
        return magnitude(-20, 99.6);  // up to 1e30
    }
  }

  Lens lens() {
    Lens lens;
    lens.focus_distance_units = focus();
    if (lens.focus_distance_units <= 0.05) {
      lens.focal_length_mm = lens.focus_distance_units * uniform(1, 999);
    }
    lens.model = below(2) ? LensModel::breathing : LensModel::cg;
    lens.aperture_diameter_mm = 1;
    // From radii that never reach a quantum to such that one float beside the focus is 2^23 quanta.
    const Exact wanted = magnitude(below(4) ? -30 : -120, 74);
    lens.aperture_diameter_mm = static_cast<double>(wanted / ExactLens(lens).scale_quanta);
    lens.aperture_diameter_mm = std::clamp(lens.aperture_diameter_mm, 1e-30, 1e30);
    return lens;
  }

  float depth(const Lens& lens, const ExactLens& exact) {
    float near = static_cast<float>(lens.focus_distance_units);
    switch (below(8)) {
      case 0:
        return static_cast<float>(magnitude(-149, 127.9));
      case 1:
        if (std::isinf(near)) return near;
        for (unsigned step = below(9); step > 0; --step) near = std::nextafter(near, infinite);
        for (unsigned step = below(9); step > 0; --step) near = std::nextafter(near, 0.0f);
        return near;
      case 2:
        return exact.depth_of(magnitude(-10, 31) * (below(2) ? 1 : -1));
      default:
        return exact.depth_of(magnitude(22.9, 30) * (below(2) ? 1 : -1));
    }
  }

 private:
  std::mt19937_64 engine_{20240607};
};

struct Worst {
  double ulp = 0, depth = 0, focus = 0, quanta = 0;
  std::size_t points = 0, measured = 0;
};

double ulp_of(Exact x) { return std::ldexp(1.0, std::ilogb(x) - 23); }

/// Checks one radius, and keeps the largest error in ulp where quanta do not hide it.
void check(std::int32_t quanta, const Lens& lens, const ExactLens& exact, float depth,
           Worst& worst) {
  const Exact radius = exact.quanta(depth);
  const Exact limited = std::fmax(-limit, std::fmin(limit, radius));
  const double error = static_cast<double>(std::fabs(quanta - limited));
  ++worst.points;
  const double ulp = limited == 0 ? 0 : ulp_of(limited);
  ASSERT_LE(error, 0.5 + bound_ulp() * ulp)
      << quanta << " for " << static_cast<double>(radius) << ": depth " << depth << ", focus "
      << lens.focus_distance_units << ", aperture " << lens.aperture_diameter_mm << " mm";
  if (std::fabs(radius) < 0x1p23 || std::fabs(quanta) < 0x1p23 || std::fabs(radius) > limit) return;
  ++worst.measured;
  ASSERT_LE(error, bound_ulp() * ulp) << quanta << " for " << static_cast<double>(radius);
  if (error / ulp <= worst.ulp) return;
  worst = {error / ulp,  depth,         lens.focus_distance_units, static_cast<double>(radius),
           worst.points, worst.measured};
}

/// Depths that some devices take for 0.
bool is_lost(float depth) {
  return !session().info().keeps_denormals && depth < std::numeric_limits<float>::min();
}

TEST(CocAccuracy, KernelIsWithinFourUlpOfTheExactRadius) {
  const std::size_t lenses = is_slow_device() ? 20 : 2000, depths = is_slow_device() ? 100 : 4096;
  Randomiser random;
  Worst worst;
  for (std::size_t i = 0; i < lenses; ++i) {
    const Lens lens = random.lens();
    const ExactLens exact(lens);
    Plane depth(depths);
    for (float& z : depth) {
      do z = random.depth(lens, exact);
      while (!(z > 0) || is_lost(z));
    }
    const auto quanta = device().coc(lens, width, depth);
    for (std::size_t k = 0; k < depths; ++k) {
      check(quanta[k], lens, exact, depth[k], worst);
      if (HasFatalFailure()) return;
    }
  }
  std::printf("coc: %.3f ulp at worst in %zu of %zu radii: depth %.9g, focus %.17g, %.9g quanta\n",
              worst.ulp, worst.measured, worst.points, worst.depth, worst.focus, worst.quanta);
  RecordProperty("worst_ulp", std::to_string(worst.ulp));
  EXPECT_GT(worst.measured, worst.points / 4);
  EXPECT_GT(worst.ulp, is_slow_device() ? 0.5 : 1);  // the measurement sees the float's roundings
}

TEST(CocAccuracy, TwinIsWithinItsDoubleRoundings) {
  // Unit, aperture, pixel scale, focal length in pixels, magnification, difference, quotient and
  // two products: nine roundings, and the breathing lens subtracts a focal length of two roundings.
  Randomiser random;
  double worst = 0;
  for (int i = 0; i < (is_slow_device() ? 50 : 1000); ++i) {
    const Lens lens = random.lens();
    const ExactLens exact(lens);
    const double f = lens.focal_length_mm / 1000, beyond = lens.focus_distance_units - f;
    const bool breathes = lens.model == LensModel::breathing && !std::isinf(beyond);
    const double roundings = 9 + (breathes ? 1 + 2 * f / beyond : 0);
    for (int k = 0; k < 500; ++k) {
      const float z = random.depth(lens, exact);
      if (!(z > 0)) continue;
      const Exact radius = exact.quanta(z);
      const Exact twin = 256 * Exact(reference::coc_px(lens, width, z));
      const Exact bound = roundings * second_order * 0x1p-53L * std::fabs(radius);
      ASSERT_LE(std::fabs(twin - radius), bound)
          << "depth " << z << ", focus " << lens.focus_distance_units;
      if (radius != 0) {
        worst = std::fmax(worst,
                          static_cast<double>(std::fabs(twin / radius - 1)) * 0x1p53 / roundings);
      }
    }
  }
  std::printf("coc's twin: %.3f of its bound at worst\n", worst);
  EXPECT_GT(worst, 0.05);
}

}  // namespace
}  // namespace defray::test::coc_accuracy_test
