#pragma once
// e^-x for Gaussians: compilers make vectors of loops over it, and none of those over std::exp.
#include <bit>
#include <cstdint>

namespace defray {

/// e^-power for 0 <= power < 80, within 10^-6 of itself: 2^whole times a polynomial (Cephes'
/// exp2f), as `splat_resolve` has it.
inline float falloff(float power) {
  const float exponent = power * -1.44269504f;
  const auto whole = static_cast<std::int32_t>(exponent - 0.5f);
  const float x = exponent - static_cast<float>(whole);  // -1/2 to 1/2
  // Pairs of terms, which do not wait for each other.
  const float x2 = x * x;
  const float high =
      (1.53533619e-4f * x + 1.33988744e-3f) * x2 + (9.61843736e-3f * x + 5.55033247e-2f);
  const float low = (0.240226479f * x2 + 0.693147203f * x) + 1.0f;
  const float mantissa = high * (x2 * x) + low;
  return mantissa * std::bit_cast<float>((whole + 127) << 23);
}

}  // namespace defray
