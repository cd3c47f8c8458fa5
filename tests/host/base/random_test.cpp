// Random numbers by place and seed: the published generator, whose first words are known.
#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace defray::test::random_test {
namespace {

/// The words that Vigna's splitmix64.c gives from state 0, as far as a double holds them.
TEST(Random, IsSplitMix64) {
  Random random(0, 0, 0);
  for (const std::uint64_t word : {0xe220a8397b1dcdafu, 0x6e789e6aa1b965f4u, 0x06c45d188009454fu,
                                   0xf88bb8a8724c81ecu, 0x1b39896a51a8749bu}) {
    EXPECT_EQ(random.next(), std::ldexp(static_cast<double>(word >> 11), -53));
  }
}

TEST(Random, BeginsWithThePlaceAndTheSeed) {
  // The state: the seed times an odd number, y from bit 20 on, x below.
  const auto first = [](int x, int y, std::uint64_t seed) { return Random(x, y, seed).next(); };
  for (const auto& [x, y, seed] : {std::array{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {7, 65535, 12345}}) {
    const std::uint64_t state =
        static_cast<std::uint64_t>(seed) * 0xd1342543de82ef95u ^
        (static_cast<std::uint64_t>(y) * 1048576 + static_cast<std::uint64_t>(x));
    std::uint64_t z = state + 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    EXPECT_EQ(first(x, y, static_cast<std::uint64_t>(seed)),
              std::ldexp(static_cast<double>(z >> 11), -53));
  }
}

}  // namespace
}  // namespace defray::test::random_test
