#include "base/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
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

namespace {

/// Floats from 0 to 1 grow with their bits, and their shown values with them: each of the 256
/// begins somewhere. What a float is shown as, it is looked for from that of its upper half's
/// smallest.
class Shown {
 public:
  Shown() {
    for (std::uint32_t value = 0; value < 256; ++value) {
      std::uint32_t low = 0, high = one;  // the first float with this value or more
      while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (rounded(middle) >= value)
          high = middle;
        else
          low = middle + 1;
      }
      begin_[value] = low;
    }
    begin_[256] = one + 1;
    for (std::uint32_t half = 0; half < half_.size(); ++half) {
      half_[half] = static_cast<std::uint8_t>(rounded(half << 16));
    }
  }

  std::uint32_t operator()(float linear) const {
    if (!(linear > 0)) return 0;
    const std::uint32_t bits = std::min(std::bit_cast<std::uint32_t>(linear), one);
    std::uint32_t value = half_[bits >> 16];
    value += begin_[value + 1] <= bits ? 1 : 0;  // no jump: mostly one step at most is left
    while (begin_[value + 1] <= bits) ++value;
    return value;
  }

 private:
  static constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);

  static std::uint32_t rounded(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::lround(255 * shown_value(std::bit_cast<float>(bits))));
  }

  std::array<std::uint32_t, 257> begin_{};
  std::array<std::uint8_t, (one >> 16) + 1> half_{};
};

}  // namespace

std::uint32_t shown_8_bit(float linear) {
  static const Shown shown;
  return shown(linear);
}

}  // namespace defray
