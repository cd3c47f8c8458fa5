#pragma once
// The sRGB transfer function (IEC 61966-2-1).
#include <cstdint>

namespace defray {

/// And its inverse, for values of any size.
double srgb_encode(double linear);
double srgb_decode(double encoded);

/// sRGB-encoded, clipped to 0...1: the values that a display gets.
double shown_value(float linear);

/// 255 times the same, to the nearest integer: without a power, from a table. NaN is 0.
std::uint32_t shown_8_bit(float linear);

}  // namespace defray
