#pragma once
// Floats at the limits.
#include <limits>

namespace defray::test {

inline constexpr float infinite = std::numeric_limits<float>::infinity();
inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float largest = std::numeric_limits<float>::max();
inline constexpr float smallest = std::numeric_limits<float>::min();  ///< Of the normal ones.
inline constexpr float denormal = std::numeric_limits<float>::denorm_min();

}  // namespace defray::test
