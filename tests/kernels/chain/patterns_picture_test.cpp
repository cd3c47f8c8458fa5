// `patterns`: what it must and must not change.
#include "patterns_scene.h"
#include "reference/reference.h"

namespace defray::test::patterns_picture_test {
namespace {

/// On pictures large enough for shifts to be found. What simulators look for, the tests above show.
class PatternPicture : public ::testing::Test {
  void SetUp() override {
    if (is_slow_device()) GTEST_SKIP() << "too large for a simulator";
  }
};

TEST_F(PatternPicture, ShiftsOfAPeriodicWallAreItsPeriods) {
  const PatternScene s = scene_of(bricks);
  const auto shifts = find_pattern_shifts(device(), s.frame(), s.words(), PatternSettings());
  ASSERT_GE(shifts.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(shifts[i].x % 24, 0) << shifts[i].x;
    EXPECT_EQ(shifts[i].y % 14, 0) << shifts[i].y;
    EXPECT_EQ(std::count(shifts.begin(), shifts.end(), shifts[i]), 1);
    const PatternShift opposite{-shifts[i].x, -shifts[i].y, 0, shifts[i].frame_square};
    EXPECT_EQ(std::count(shifts.begin(), shifts.end(), opposite), 1);
  }
}

TEST_F(PatternPicture, ShiftsFromOneSurfaceToAnotherDoNotCount) {
  const auto halves = [](int x, int y, int c) { return noise(x % 100, y, c); };
  const auto finds_half = [](const PatternScene& s) {
    const auto shifts = find_pattern_shifts(device(), s.frame(), s.words(), PatternSettings());
    return std::count_if(shifts.begin(), shifts.end(),
                         [](const PatternShift& s) { return s.x == 100 && s.y == 0; });
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

/// Tiles on a floor: 1/depth grows with the rows, and CoC with it. Turned, a wall on the left.
PatternScene slanting_scene(bool is_turned) {
  const auto inverse = [](int row) { return 0.004f * static_cast<float>(row + 40); };
  const auto tiles = [=](int x, int y, int c) {
    const int along = is_turned ? y : x, row = is_turned ? x : y;
    const double u = (along - 60) / inverse(row), v = 6 / inverse(row);
    return static_cast<float>(0.5 + 0.2 * std::sin(u / 12 + c) + 0.2 * std::sin(v + 2 * c));
  };
  PatternScene s(is_turned ? Size{120, 300} : Size{300, 120});
  s.paint(tiles, [=](int x, int y) { return bar(is_turned ? y : x, 0); });
  for (std::size_t i = 0; i < s.pixels(); ++i) {
    const int x = static_cast<int>(i) % s.size.width, y = static_cast<int>(i) / s.size.width;
    s.inverse[i] = s.behind_inverse[i] = inverse(is_turned ? x : y);
    s.behind_coc[i] = static_cast<std::int32_t>(-9000 * s.inverse[i]);
    if (!s.is_behind[i]) s.coc[i] = s.behind_coc[i];
    for (int c = 0; c < 3; ++c) s.truth[static_cast<std::size_t>(c)][i] = tiles(x, y, c);
  }
  return s;
}

TEST_F(PatternPicture, AFloorAndAWallThatSlantComeBackBehindABar) {
  for (const bool is_turned : {false, true}) {
    const PatternScene s = slanting_scene(is_turned);
    const auto wall = [&](int x, int y, int c) {
      return s.truth[static_cast<std::size_t>(c)][s.at(x, y)];
    };
    PatternSettings without;
    without.parallel_shifts = 0;
    const double before = s.error(s.improved(without), wall), after = s.error(s.improved(), wall);
    EXPECT_LT(after, 0.2 * before) << before;
    EXPECT_GT(before, 0.05);
  }
}

TEST_F(PatternPicture, ParallelShiftsOfAFloorAreItsPeriodAndFrontalWallsHaveNone) {
  const PatternScene s = slanting_scene(false);
  const auto shifts = find_parallel_shifts(s.frame(), s.words(), PatternSettings());
  ASSERT_GE(shifts.size(), 2u);
  const double period = 2 * std::numbers::pi * 12;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(shifts[i].parallel / period, std::round(shifts[i].parallel / period), 0.02);
    EXPECT_EQ(shifts[i].y, 0);
  }
  EXPECT_EQ(shifts[0].x, -shifts[1].x);
  const PatternScene frontal = scene_of(bricks);
  EXPECT_TRUE(find_parallel_shifts(frontal.frame(), frontal.words(), PatternSettings()).empty());
}

TEST_F(PatternPicture, ParallelShiftsAreLookedForInAllOfALargeFloor) {
  // Tiles below what is plain: of more pixels than are compared, those of all rows count.
  const auto inverse = [](int row) { return 0.001f * static_cast<float>(row + 160); };
  const auto tiles = [=](int x, int y, int c) {
    const double u = (x - 300) / inverse(y);
    return static_cast<float>(y < 220 ? 0.5 : 0.5 + 0.3 * std::sin(u / 12 + c));
  };
  PatternScene s({600, 480});
  s.paint(tiles, bar);
  for (std::size_t i = 0; i < s.pixels(); ++i) {
    s.inverse[i] = inverse(static_cast<int>(i) / 600);
    if (!s.is_behind[i]) s.coc[i] = static_cast<std::int32_t>(-9000 * s.inverse[i]);
  }
  const auto shifts = find_parallel_shifts(s.frame(), s.words(), PatternSettings());
  ASSERT_GE(shifts.size(), 2u);
  const double period = 2 * std::numbers::pi * 12;
  const double periods = shifts[0].parallel / period;  // lengths are refined by 1/400
  EXPECT_NEAR(periods, std::round(periods), 0.0025 * periods);
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
}  // namespace defray::test::patterns_picture_test
