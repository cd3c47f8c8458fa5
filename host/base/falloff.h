#pragma once
// e^-x for Gaussians: compilers make vectors of loops over it, and none of those over std::exp.
#include <bit>
#include <cstdint>

namespace defray {

/// e^-power for 0 <= power < 80, within 10^-6 of itself (2 10^-6 from 10 on): 2^whole times a
/// polynomial of degree 5 for what is left, as `splat_resolve` has it.
inline float falloff(float power) {
  constexpr float rounding = 0x1.8p23f;  // added, it leaves no bits behind the point
  const float exponent = power * -1.44269504f;
  const std::int32_t whole =
      std::bit_cast<std::int32_t>(exponent + rounding) - std::bit_cast<std::int32_t>(rounding);
  const float x = exponent - static_cast<float>(whole);  // -1/2 to 1/2
  // Pairs of terms, which do not wait for each other.
  const float x2 = x * x;
  const float low = 0.693147004f * x + 1.0f;
  const float middle = 0.0555073358f * x + 0.240222424f;
  const float high = 0.00132647273f * x + 0.00967151299f;
  const float mantissa = (high * x2 + middle) * x2 + low;
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(mantissa) + (whole << 23));
}

}  // namespace defray
