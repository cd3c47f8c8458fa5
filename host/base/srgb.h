#pragma once
// The sRGB transfer function (IEC 61966-2-1).

namespace defray {

/// And its inverse, for values of any size.
double srgb_encode(double linear);
double srgb_decode(double encoded);

/// sRGB-encoded, clipped to 0...1: the values that a display gets.
double shown_value(float linear);

}  // namespace defray
