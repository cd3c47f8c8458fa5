// `patterns`: what it must and must not change.
#include "pattern_scene.h"
#include "pattern_window.h"
#include "reference/reference.h"

namespace defray::test {
namespace {

/// On pictures large enough for shifts to be found. What simulators look for, the tests above show.
class PatternPicture : public ::testing::Test {
  void SetUp() override {
    if (is_slow_device()) GTEST_SKIP() << "too large for a simulator";
  }
};

TEST_F(PatternPicture, ShiftsOfAPeriodicWallAreItsPeriods) {
  const PatternScene s = scene_of(bricks);
  const auto shifts =
      find_pattern_shifts(s.frame(), pattern_pixels(s.frame(), s.channels), PatternSettings());
  ASSERT_GE(shifts.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(shifts[i].x % 24, 0) << shifts[i].x;
    EXPECT_EQ(shifts[i].y % 14, 0) << shifts[i].y;
    EXPECT_EQ(std::count(shifts.begin(), shifts.end(), shifts[i]), 1);
    EXPECT_EQ(std::count(shifts.begin(), shifts.end(), PatternShift{-shifts[i].x, -shifts[i].y}),
              1);
  }
}

TEST_F(PatternPicture, ShiftsFromOneSurfaceToAnotherDoNotCount) {
  const auto halves = [](int x, int y, int c) { return noise(x % 100, y, c); };
  const auto finds_half = [](const PatternScene& s) {
    const auto shifts =
        find_pattern_shifts(s.frame(), pattern_pixels(s.frame(), s.channels), PatternSettings());
    return std::count(shifts.begin(), shifts.end(), PatternShift{100, 0});
  };
  PatternScene s(picture);
  s.paint(halves, [](int, int) { return false; });
  EXPECT_EQ(finds_half(s), 1);
  for (std::size_t i = 0; i < s.pixels(); ++i) s.coc[i] = i % 200 < 100 ? 512 : 1024;
  EXPECT_EQ(finds_half(s), 0);
}

TEST_F(PatternPicture, APeriodicWallComesBackBehindABar) {
  const PatternScene s = scene_of(bricks);
  const auto planes = s.improved();
  EXPECT_LT(s.error(planes, bricks), 0.05 * s.error(s.behind, bricks));
}

TEST_F(PatternPicture, NoiseStaysSmooth) {
  const PatternScene s = scene_of(noise);
  const auto planes = s.improved();
  const auto smooth = [](int, int, int) { return 0.5f; };
  EXPECT_LT(s.error(planes, smooth), 0.03);
  EXPECT_LT(s.error(planes, noise), 1.01 * s.error(s.behind, noise));
}

TEST_F(PatternPicture, OnlyFragmentsChange) {
  for (const auto wall : {bricks, noise}) {
    const PatternScene s = scene_of(wall);
    const auto planes = s.improved();
    for (std::size_t i = 0; i < s.pixels(); ++i) {
      ASSERT_TRUE(s.is_behind[i] || planes[0][i] == s.behind[0][i]) << i;
    }
  }
}

TEST_F(PatternPicture, NothingKnownOrNothingBehindChangesNothing) {
  PatternScene unknown = scene_of(bricks);
  for (std::uint32_t& v : unknown.encoded) v &= ~DEFRAY_PATTERN_KNOWN;
  EXPECT_EQ(unknown.improved(), unknown.behind);
  PatternScene whole = scene_of(bricks);
  whole.is_behind.assign(whole.pixels(), 0);
  EXPECT_EQ(whole.improved(), whole.behind);
}

TEST_F(PatternPicture, AConstantChannelStaysConstantBitForBit) {
  // Green varies, so that there is something to match.
  const auto wall = [](int x, int y, int c) { return c == 1 ? bricks(x, y, c) : 0.3f; };
  PatternScene s(picture);
  s.paint(wall, bar);
  for (const std::size_t c : {0, 2}) s.behind[c].assign(s.pixels(), 0.3f);
  const auto planes = s.improved();
  EXPECT_EQ(planes[0], s.behind[0]);
  EXPECT_EQ(planes[2], s.behind[2]);
  EXPECT_NE(planes[1], s.behind[1]);
}

TEST_F(PatternPicture, AConstantWallStaysConstantBitForBit) {
  PatternScene s(picture);
  s.paint([](int, int, int) { return 0.3f; }, bar);
  s.behind.assign(3, Plane(s.pixels(), 0.3f));
  EXPECT_EQ(s.improved(), s.behind);
}

TEST_F(PatternPicture, HighlightsAndNonsenseAreNotCopied) {
  for (const float outlier : {40.0f, 1.001f, -40.0f, HUGE_VALF, std::nanf("")}) {
    PatternScene s = scene_of(bricks);
    // One period beside what is hidden.
    for (int y = 0; y < s.size.height; y += 9) {
      const std::size_t i = s.at(72, y);
      s.channels[1][i] = outlier;
      if (outlier > 1) s.encoded[i] |= 255 << 8;
    }
    const auto planes = s.improved();
    for (std::size_t i = 0; i < s.pixels(); ++i) {
      ASSERT_TRUE(!s.is_behind[i] || std::fabs(planes[1][i] - 0.5f) <= 0.5f) << outlier;
    }
    EXPECT_LT(s.error(planes, bricks), 0.05 * s.error(s.behind, bricks)) << outlier;
  }
}

TEST_F(PatternPicture, AnotherSurfaceIsNotCopied) {
  // The right half is another wall, brighter, of the same pattern: the bar hides the left one. Of a
  // narrow bar: the left wall alone must be a tenth of a window, at the frame's edges too.
  const auto wall = [](int x, int y, int c) { return bricks(x, y, c) * (x < 104 ? 0.5f : 1.0f); };
  PatternScene s(picture);
  s.paint(wall, [](int x, int) { return x >= 95 && x < 104; });
  for (int y = 0; y < s.size.height; ++y) {
    for (int x = 104; x < s.size.width; ++x) s.coc[s.at(x, y)] = 1024;
  }
  const auto planes = s.improved();
  EXPECT_LT(s.error(planes, wall), 0.05 * s.error(s.behind, wall));
}

}  // namespace
}  // namespace defray::test
