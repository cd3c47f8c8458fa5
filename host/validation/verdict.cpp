#include "validation/verdict.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace defray::validation {
namespace {

constexpr double u = 0x1p-24;

/// Place among all floats from -inf to inf, -0 before +0.
std::int64_t place(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  return bits < 0 ? -std::int64_t{bits & std::numeric_limits<std::int32_t>::max()} - 1
                  : std::int64_t{bits};
}

double largest_magnitude(const Plane& plane) {
  double largest = 0;
  for (const float v : plane) {
    if (std::isfinite(v)) largest = std::max(largest, std::fabs(static_cast<double>(v)));
  }
  return largest;
}

/// Infinite results on one side only: an overflow that the slack must explain.
bool is_within(float a, float b, double slack) {
  if (ulp_distance(a, b) == 0 || slack == 0) return ulp_distance(a, b) == 0;  // -0 is not 0
  if (std::isfinite(a) && std::isfinite(b)) {
    return std::fabs(static_cast<double>(a) - static_cast<double>(b)) <= slack;
  }
  return slack >= std::numeric_limits<float>::max() * u;
}

void compare_integers(const KernelCheck& check, const Outcome& kernel, const Outcome& twin,
                      Verdict& v) {
  const bool is_bounded = check.exact && twin.planes.empty();
  for (std::size_t i = 0; i < twin.integers.size(); ++i) {
    const std::int64_t difference = std::abs(kernel.integers[i] - twin.integers[i]);
    if (difference == 0) continue;
    ++v.differing;
    if (!is_bounded) ++v.wrong;
    if (static_cast<double>(difference) > v.worst) {
      v.worst = static_cast<double>(difference);
      v.worst_at = i;
    }
  }
}

void compare_plane(const Plane& kernel, const Plane& twin, double slack, std::size_t first,
                   Verdict& v) {
  for (std::size_t i = 0; i < twin.size(); ++i) {
    const std::uint32_t distance = ulp_distance(kernel[i], twin[i]);
    ++v.ulp_histogram[ulp_bin(distance)];
    if (distance == 0) continue;
    ++v.differing;
    if (!is_within(kernel[i], twin[i], slack)) ++v.wrong;
    if (distance > v.worst) {
      v.worst = distance;
      v.worst_at = first + i;
    }
  }
}

}  // namespace

std::uint32_t ulp_distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) {
    return std::isnan(a) && std::isnan(b) ? 0 : std::numeric_limits<std::uint32_t>::max();
  }
  return static_cast<std::uint32_t>(std::abs(place(a) - place(b)));
}

std::size_t ulp_bin(std::uint32_t distance) {
  return distance == 0 ? 0 : static_cast<std::size_t>(std::bit_width(distance - 1)) + 1;
}

std::string ulp_bin_name(std::size_t bin) {
  if (bin < 3) return std::to_string(bin);
  const std::uint64_t last = std::uint64_t{1} << (bin - 1);
  return std::to_string(last / 2 + 1) + "-" + std::to_string(last);
}

bool Verdict::has_floats() const {
  return std::any_of(ulp_histogram.begin(), ulp_histogram.end(), [](auto n) { return n > 0; });
}

bool Verdict::add(const Verdict& other) {
  compared += other.compared;
  differing += other.differing;
  wrong += other.wrong;
  for (std::size_t i = 0; i < ulp_bins; ++i) ulp_histogram[i] += other.ulp_histogram[i];
  exact_share = std::max(exact_share, other.exact_share);
  if (other.worst <= worst) return false;
  worst = other.worst;
  worst_at = other.worst_at;
  return true;
}

Verdict compare(const KernelCheck& check, const Case& c, const Input& in, const Outcome& kernel,
                const Outcome& twin, bool keeps_denormals, bool rounds_divisions) {
  Verdict v;
  v.compared = twin.integers.size();
  for (const Plane& plane : twin.planes) v.compared += plane.size();
  compare_integers(check, kernel, twin, v);
  for (std::size_t p = 0; p < twin.planes.size(); ++p) {
    double slack = 0;
    if (!rounds_divisions && check.loose_roundings) {
      const Plane& source = p < in.channels.size() ? in.channels[p] : twin.planes[p];
      slack += check.loose_roundings(c) * largest_magnitude(source) * u;
    }
    // Each term of a sum may have been flushed to zero, and its factors before it.
    if (!keeps_denormals) slack += 4.0 * static_cast<double>(twin.planes[p].size() + 64) * 0x1p-126;
    compare_plane(kernel.planes[p], twin.planes[p], slack,
                  twin.integers.size() + p * twin.planes[p].size(), v);
  }
  return v;
}

void compare_exact(const Exact& exact, const Input& in, const Outcome& kernel, Verdict& verdict) {
  const auto hold = [&](double value, double expected, double bound) {
    const double error = std::fabs(value - expected);
    if (!(error <= bound)) ++verdict.wrong;
    if (bound > 0) verdict.exact_share = std::max(verdict.exact_share, error / bound);
  };
  // Beside floats the bound is theirs, and whole numbers are equal.
  const std::size_t bounded = kernel.planes.empty() ? kernel.integers.size() : 0;
  for (std::size_t i = 0; i < bounded; ++i) {
    const double expected = exact.planes[0][i];
    hold(static_cast<double>(kernel.integers[i]), expected,
         0.5 + exact.roundings * std::fabs(expected) * u);
  }
  for (std::size_t p = 0; p < kernel.planes.size(); ++p) {
    const Plane& source = in.channels[p];
    const bool is_finite =
        std::all_of(source.begin(), source.end(), [](float v) { return std::isfinite(v); });
    const double largest = largest_magnitude(source);
    // Sums of the largest floats overflow: they have no bound.
    if (!is_finite || exact.roundings * largest > std::numeric_limits<float>::max()) continue;
    // Near 0 a rounding is at most half the smallest denormal, however small the values.
    const double bound = exact.roundings * (largest * u + 0x1p-149);
    for (std::size_t i = 0; i < kernel.planes[p].size(); ++i) {
      hold(static_cast<double>(kernel.planes[p][i]), exact.planes[p][i], bound);
    }
  }
}

std::uint64_t hash_of(const Outcome& values) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3u; };
  for (const std::int64_t i : values.integers) add(static_cast<std::uint64_t>(i));
  for (const Plane& plane : values.planes) {
    // One NaN for all: OpenCL does not say which bits it has.
    for (const float v : plane) add(std::isnan(v) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(v));
  }
  return hash;
}

}  // namespace defray::validation
