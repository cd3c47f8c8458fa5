#pragma once
// What the properties share: frames that rapidcheck makes and shrinks, and what rounding may do.
#include <string>
#include <vector>

#include "methods/method.h"
#include "support.h"

namespace defray::test {

struct RandomFrame {
  Size size;
  std::vector<std::int32_t> coc;  ///< Quanta, up to reach_px.
  Plane depth;
  std::vector<Plane> channels;  ///< One.

  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * size.width + x; }
};

/// Largest |CoC radius| of these frames, px.
inline constexpr int reach_px = 5;

/// A frame of any size up to 40x30 (shrinks to one pixel), of this size, or of any content that
/// rapidcheck chose (shrinks to a small seed). Depths hold ties.
RandomFrame any_frame();
RandomFrame any_frame(Size size);
Size any_size();

/// rdb, linear, gather literal and aware, the latter two with one or two passes.
MethodSettings any_method();
std::string name_of(const MethodSettings& settings);

/// The one channel through the lens, on the device under test.
Plane render(const RandomFrame& frame, const MethodSettings& settings);

/// All methods are linear in colour: a pixel is a sum of others, weighed by geometry alone, and the
/// weights are the same floats whatever the colours. Largest |error| of a pixel of `render` against
/// that sum for colours up to 1, first order in u = 2^-24.
///
/// - rdb, n cells: n differences <= 2 and their sums <= 2 n, each rounded, over n; the division of
///   at most 2; the first colour's addition: 2 + 2 n + 2 + 1 u.
/// - linear, n = (2 reach + 1)^2 terms: each a quotient and a product (2 u), added one by one (n
/// u),
///   all of it times the pixel's weights, which add up to `linear_weight`.
/// - literal, n samples: bilinear is two differences and sums a row (5 u), one between the rows
///   (12 + 2 + 5 + 1 u), less the own colour (2 u): 22 u a sample; sums <= 2 n: 2 n u; the division
///   and the last sum: 3 u.
/// - aware: as a mean of n differences, twice (near and base, 4 + 2 n + 2 u each), the base's share
///   (2 u), and two sums (2 + 3 u).
/// A pass adds its own error to that of the one before: weights are >= 0 and add up to 1.
double rounding_of(const MethodSettings& settings, double linear_weight = 1);

/// Largest sum of weights in a pixel: 1 but for `linear`, whose pixels may get more.
double largest_weight(const RandomFrame& frame, const MethodSettings& settings);

double largest(const Plane& plane);

/// Largest difference between two planes, taken in double.
double difference(const Plane& a, const Plane& b);

std::uint64_t bits(const Plane& plane);

}  // namespace defray::test
