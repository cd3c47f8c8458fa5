#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace defray {

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double shown_value(float linear) {
  return srgb_encode(std::clamp(static_cast<double>(linear), 0.0, 1.0));
}

}  // namespace defray
