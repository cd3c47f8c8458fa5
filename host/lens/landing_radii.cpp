#include "lens/landing_radii.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/plane.h"
#include "kernels/params.h"

namespace defray {
namespace {

constexpr std::int64_t half_pixel = std::int64_t{1}
                                    << (DEFRAY_COC_FRACTION_BITS + DEFRAY_LENS_FRACTION_BITS - 1);

/// Sums of even powers of numbers, the second first.
using Moments = std::array<double, 6>;

void add(double x, Moments& sums) {
  double power = 1;
  for (double& sum : sums) sum += power *= x * x;
}

/// Sum of 1 - cos(k r x) over the numbers x: by its series, with the same bits everywhere.
double faded(double r, const Moments& moments) {
  constexpr double cycles_a_px = 0.4, k = 2 * 3.14159265358979323846 * cycles_a_px;
  double term = 1, sum = 0, n = 0;
  for (const double moment : moments) {
    term *= -(k * r) * (k * r) / ((n + 1) * (n + 2));
    n += 2;
    sum -= term * moment;
  }
  return sum;
}

/// The least radius whose ray through this coordinate leaves its pixel.
std::int64_t leaves_at(std::int64_t u) {
  const std::int64_t needed = u > 0 ? half_pixel + 1 : half_pixel, along = std::abs(u);
  return (needed + along - 1) / along;
}

/// For each radius, how many coordinates leave the pixel.
std::vector<double> leaving(const LensPoints& lens) {
  std::vector<double> count(DEFRAY_SMALL_QUANTA + 1);
  for (const auto& point : lens.points) {
    for (const std::int64_t u : point) {
      if (u == 0) continue;
      const std::int64_t from = leaves_at(u);
      if (from <= DEFRAY_SMALL_QUANTA) ++count[static_cast<std::size_t>(from)];
    }
  }
  for (std::size_t w = 1; w < count.size(); ++w) count[w] += count[w - 1];
  return count;
}

}  // namespace

std::vector<std::int32_t> landing_radii(const LensPoints& lens) {
  Moments of_lens{}, of_a_pixel{};
  for (const auto& point : lens.points) {
    for (const std::int32_t u : point) add(u * 0x1p-16, of_lens);
  }
  add(1, of_a_pixel);
  const std::vector<double> left = leaving(lens);
  std::vector<std::int32_t> radii(DEFRAY_SMALL_QUANTA);
  std::size_t w = 0, least = 0;
  for (std::size_t r = 1; r < radii.size(); ++r) {
    const double wanted =
        faded(static_cast<double>(r) / DEFRAY_SMALL_QUANTA, of_lens) / faded(1, of_a_pixel);
    while (w + 1 < left.size() && left[w] < wanted) ++w;
    const bool is_before_nearer = w > 0 && wanted - left[w - 1] < left[w] - wanted;
    const std::size_t nearest = is_before_nearer ? w - 1 : w;
    least = std::max(least, left[nearest] > 0 ? nearest : 0);
    radii[r] = static_cast<std::int32_t>(least);
  }
  return radii;
}

std::int64_t landing_radius(const LensPoints& lens, std::int64_t radius) {
  const std::size_t size = static_cast<std::size_t>(std::abs(radius));
  if (size >= lens.landing_radii.size()) return radius;
  return radius < 0 ? -lens.landing_radii[size] : lens.landing_radii[size];
}

std::int64_t first_landing_as(const LensPoints& lens, std::int64_t landing) {
  const auto& radii = lens.landing_radii;
  const auto size = static_cast<std::int64_t>(radii.size());  // which a radius may land as
  if (landing > size || landing <= -size) return landing;
  if (landing > 0) return std::lower_bound(radii.begin(), radii.end(), landing) - radii.begin();
  return radii.begin() - std::upper_bound(radii.begin(), radii.end(), -landing) + 1;
}

}  // namespace defray
