// Kernel split: lamps behind what is before them.
#include "stages_support.h"

namespace defray::test::split_lamp_test {
namespace {

constexpr std::int32_t bar_coc = -512;

/// A lamp of 5 x 5 px, and a dark blade of a pixel's width whose tip covers a third of three of
/// them.
Canvas lamp_behind_a_blade(float blade) {
  Canvas f(40, 20);
  f.each([&](int x, int y) {
    const bool is_lamp = x >= 18 && x < 23 && y >= 6 && y < 11, is_blade = x == 20 && y >= 8;
    const float there = is_lamp ? 60.0f : 0.1f;
    const float c = is_blade ? (is_lamp ? 2 * there / 3 + blade / 3 : blade) : there;
    f.paint(x, y, c, c, c);
    if (is_lamp) f.coc[f.at(x, y)] = 1400, f.inverse[f.at(x, y)] = 0.21f;
    if (is_blade) f.coc[f.at(x, y)] = bar_coc, f.inverse[f.at(x, y)] = 0.5f;
  });
  return f;
}

TEST(Split, ABladeBeforeALampHasNoneOfItsLight) {
  const Canvas f = lamp_behind_a_blade(0.3f);
  const auto [front, behind] = f.parted();
  for (std::size_t i = 0; i < f.count(); ++i) {
    if (front.coc_quanta[i] == bar_coc) EXPECT_LT(front.channels[0][i], 1) << i;
  }
  for (int y = 8; y < 11; ++y) {
    const std::size_t i = f.at(20, y);
    EXPECT_EQ(front.coc_quanta[i], bar_coc) << y;
    EXPECT_NEAR(front.coverage[i] / 65536.0, 1 / 3.0, 0.02) << y;
    EXPECT_NEAR(behind.channels[0][i], 60, 1) << y;
    EXPECT_EQ(behind.coc_quanta[i], 1400) << y;
    EXPECT_FLOAT_EQ(behind.depth[i], 1 / 0.21f) << y;
  }
  // One that is as bright as the lamp keeps its light.
  const Canvas bright = lamp_behind_a_blade(70);
  EXPECT_GT(bright.parted().front.channels[0][bright.at(20, 9)], 50);
}

/// A lamp of 4 x 2 px, the last column of which a dark bar covers by half.
TEST(Split, ABarBeforeALampHasNoneOfItsLight) {
  Canvas f(40, 20);
  f.add_bar(22, 40, bar_coc);
  f.each([&](int x, int y) {
    const bool is_lamp = x >= 19 && x < 23 && y >= 8 && y < 10;
    const float there = is_lamp ? 60.0f : 0.1f;
    const float c = x > 22 ? 0.3f : x == 22 ? (there + 0.3f) / 2 : there;
    f.paint(x, y, c, c, c);
    if (is_lamp && x < 22) f.coc[f.at(x, y)] = 1400, f.inverse[f.at(x, y)] = 0.21f;
  });
  const auto [front, behind] = f.parted();
  for (int y = 8; y < 10; ++y) {
    const std::size_t i = f.at(22, y);
    EXPECT_LT(front.channels[0][i], 1) << y;
    EXPECT_EQ(front.coc_quanta[i], bar_coc) << y;
    EXPECT_NEAR(front.coverage[i] / 65536.0, 0.5, 0.02) << y;
    EXPECT_NEAR(behind.channels[0][i], 60, 1) << y;
    EXPECT_EQ(behind.coc_quanta[i], 1400) << y;
  }
}

}  // namespace
}  // namespace defray::test::split_lamp_test
