// Values as a display gets them: the table against the formula.
#include "base/srgb.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace defray::test::srgb_test {
namespace {

long by_formula(float linear) { return std::lround(255 * shown_value(linear)); }

TEST(Srgb, EightBitsAreTheRoundedShownValue) {
  const std::uint32_t end = std::bit_cast<std::uint32_t>(1.0f) + 4;
  for (std::uint32_t bits = 0; bits < end; bits += 997) {
    const float linear = std::bit_cast<float>(bits);
    ASSERT_EQ(shown_8_bit(linear), by_formula(linear)) << linear;
  }
}

/// Where one value ends and the next begins, on both sides.
TEST(Srgb, EightBitsChangeWhereTheFormulaDoes) {
  for (int value = 0; value < 255; ++value) {
    const auto border = static_cast<float>(srgb_decode((value + 0.5) / 255));
    float linear = border;
    for (int i = 0; i < 8; ++i) linear = std::nextafter(linear, 0.0f);
    for (int i = 0; i < 16; ++i, linear = std::nextafter(linear, 1.0f)) {
      ASSERT_EQ(shown_8_bit(linear), by_formula(linear)) << value;
    }
  }
}

TEST(Srgb, EightBitsAreClipped) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float linear : {1.0f, 1.001f, 7e30f, infinity}) EXPECT_EQ(shown_8_bit(linear), 255u);
  for (const float linear : {0.0f, -0.0f, -1e-9f, -infinity}) EXPECT_EQ(shown_8_bit(linear), 0u);
  EXPECT_EQ(shown_8_bit(std::numeric_limits<float>::quiet_NaN()), 0u);
}

}  // namespace
}  // namespace defray::test::srgb_test
