// `patterns`: the kernels against their twins, and what they must and must not change.
#include "patterns.h"

#include <cmath>
#include <numbers>

#include "pattern_window.h"
#include "random.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test {
namespace {

/// A wall, and a bar in front of it that hides a part. Colours are linear and encoded at once: the
/// stage does not ask which curve lies between.
struct Scene {
  explicit Scene(Size s) : size(s), encoded(pixels()), coc(pixels()), behind_coc(pixels()) {
    is_behind.resize(pixels());
    channels.assign(3, Plane(pixels()));
    behind.assign(3, Plane(pixels()));
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }

  /// The wall's colours everywhere; `hidden(x, y)` says where the bar is.
  template <typename Wall, typename Hidden>
  void paint(const Wall& wall, const Hidden& hidden) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const std::size_t i = at(x, y);
        is_behind[i] = hidden(x, y);
        encoded[i] = is_behind[i] ? 0 : DEFRAY_PATTERN_KNOWN;
        coc[i] = is_behind[i] ? -2560 : 512;
        behind_coc[i] = 512;
        for (std::size_t c = 0; c < 3; ++c) {
          const float v = is_behind[i] ? 0.9f : wall(x, y, static_cast<int>(c));
          channels[c][i] = v;
          behind[c][i] = is_behind[i] ? 0.5f : -7.0f;  // not to be touched
          const float clipped = std::clamp(v, 0.0f, 1.0f);
          encoded[i] |= static_cast<std::uint32_t>(std::lround(255 * clipped)) << (8 * c);
        }
      }
    }
  }

  PatternFrame frame() const {
    return {size.width, size.height, encoded, coc, behind_coc, is_behind};
  }

  std::vector<Plane> improved(const PatternSettings& settings = {}) const {
    std::vector<Plane> planes = behind;
    improve_by_patterns(session(), frame(), channels, settings, planes);
    return planes;
  }

  /// Root mean square distance to the wall, over what is hidden.
  template <typename Wall>
  double error(const std::vector<Plane>& planes, const Wall& wall) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < pixels(); ++i) {
      if (!is_behind[i]) continue;
      const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
      for (int c = 0; c < 3; ++c) {
        const double d = planes[static_cast<std::size_t>(c)][i] - wall(x, y, c);
        sum += d * d;
        ++count;
      }
    }
    return std::sqrt(sum / count);
  }

  Size size;
  std::vector<std::uint32_t> encoded;
  std::vector<std::int32_t> coc, behind_coc;
  std::vector<std::uint32_t> is_behind;
  std::vector<Plane> channels, behind;
};

constexpr Size picture{200, 120};

/// Bricks: 24 px wide, 14 px high.
float bricks(int x, int y, int c) {
  const double u = 2 * std::numbers::pi * x / 24, v = 2 * std::numbers::pi * y / 14;
  return static_cast<float>(0.5 + 0.2 * std::sin(u + c) + 0.2 * std::sin(v + 2 * c));
}

float noise(int x, int y, int c) { return static_cast<float>(Random(x, y, 17 + c).next()); }

bool bar(int x, int) { return x >= 90 && x < 104; }

Scene scene_of(float (*wall)(int, int, int), Size size = picture) {
  Scene s(size);
  s.paint(wall, bar);
  return s;
}

/// Known pixels, fragments and radii for each pixel by itself; so large a share hides something.
Scene random_scene(Size size, double share) {
  Scene s(size);
  s.paint(noise, [](int, int) { return false; });
  for (std::size_t i = 0; i < s.pixels(); ++i) {
    Random random(static_cast<int>(i), 3, 5);
    s.is_behind[i] = random.next() < share || i == s.pixels() / 2;
    if (random.next() < 0.2) s.encoded[i] &= ~DEFRAY_PATTERN_KNOWN;
    s.coc[i] = static_cast<std::int32_t>(1000 * random.next());
    s.behind_coc[i] = static_cast<std::int32_t>(1000 * random.next());
  }
  return s;
}

std::uint64_t hash_of_sums(const PatternSums& s) {
  std::vector<Plane> all = s.difference;
  all.push_back(s.weight);
  all.push_back(s.weighted_square);
  return hash_of(all);
}

const std::vector<PatternShift> some_shifts{{3, 1}, {-3, -1}, {0, 5}, {-40, 0}, {1000, 3}, {0, 0}};

void expect_twins_bits(const Scene& s, PatternSettings settings) {
  const Size size = s.size;
  const auto pixels = pattern_pixels(s.frame(), s.channels);
  const std::uint64_t twin = hash_of_sums(
      reference::match_patterns(s.frame(), pixels, s.channels, s.behind, some_shifts, settings));
  const PatternMargins margins(some_shifts, settings.window_px);
  for (const int rows : {0, 1, 7, 64}) {
    if (rows == 1 && size.height > 50) continue;
    if (rows > 0) settings.memory_bytes = pattern_band_bytes(size.width, margins, rows);
    session().set_work_group(rows == 7 ? 3 : 0, rows == 7 ? 1 : 0);
    EXPECT_EQ(hash_of_sums(match_patterns(session(), s.frame(), pixels, s.channels, s.behind,
                                          some_shifts, settings)),
              twin)
        << size.width << "x" << size.height << ", window " << settings.window_px << ", rows "
        << rows;
  }
  session().set_work_group(0, 0);
}

TEST(Patterns, KernelsEqualTwinsBitForBitWhateverBandsAndWorkGroups) {
  for (const Size size : awkward_sizes()) {
    if (is_slow_device() && size.width * size.height > 400) continue;
    for (const double share : {0.3, 0.002}) {
      for (const int window_px : {1, 2, 9, 25}) {
        if (is_slow_device() && window_px > 9) continue;
        PatternSettings settings;
        settings.window_px = window_px;
        expect_twins_bits(random_scene(size, share), settings);
      }
    }
  }
}

/// On pictures large enough for shifts to be found. What simulators look for, the tests above show.
class PatternPicture : public ::testing::Test {
  void SetUp() override {
    if (is_slow_device()) GTEST_SKIP() << "too large for a simulator";
  }
};

TEST_F(PatternPicture, TheLargestWindowFullOfTheLargestDifferencesFits) {
  Scene s({100, 100});
  s.paint([](int x, int, int) { return x % 2 ? 1.0f : 0.0f; }, [](int, int) { return false; });
  s.is_behind.assign(s.pixels(), 1);
  PatternSettings settings;
  settings.window_px = DEFRAY_PATTERN_LARGEST_WINDOW;
  const auto pixels = pattern_pixels(s.frame(), s.channels);
  const PatternSums sums =
      match_patterns(session(), s.frame(), pixels, s.channels, s.behind, {{1, 0}}, settings);
  const std::size_t middle = s.at(50, 50);
  EXPECT_NEAR(sums.weighted_square[middle] / sums.weight[middle], 3 * 255 * 255, 1);
  EXPECT_EQ(hash_of_sums(sums), hash_of_sums(reference::match_patterns(
                                    s.frame(), pixels, s.channels, s.behind, {{1, 0}}, settings)));
}

TEST_F(PatternPicture, ShiftsOfAPeriodicWallAreItsPeriods) {
  const Scene s = scene_of(bricks);
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
  const auto finds_half = [](const Scene& s) {
    const auto shifts =
        find_pattern_shifts(s.frame(), pattern_pixels(s.frame(), s.channels), PatternSettings());
    return std::count(shifts.begin(), shifts.end(), PatternShift{100, 0});
  };
  Scene s(picture);
  s.paint(halves, [](int, int) { return false; });
  EXPECT_EQ(finds_half(s), 1);
  for (std::size_t i = 0; i < s.pixels(); ++i) s.coc[i] = i % 200 < 100 ? 512 : 1024;
  EXPECT_EQ(finds_half(s), 0);
}

TEST_F(PatternPicture, APeriodicWallComesBackBehindABar) {
  const Scene s = scene_of(bricks);
  const auto planes = s.improved();
  EXPECT_LT(s.error(planes, bricks), 0.05 * s.error(s.behind, bricks));
}

TEST_F(PatternPicture, NoiseStaysSmooth) {
  const Scene s = scene_of(noise);
  const auto planes = s.improved();
  const auto smooth = [](int, int, int) { return 0.5f; };
  EXPECT_LT(s.error(planes, smooth), 0.03);
  EXPECT_LT(s.error(planes, noise), 1.01 * s.error(s.behind, noise));
}

TEST_F(PatternPicture, OnlyFragmentsChange) {
  for (const auto wall : {bricks, noise}) {
    const Scene s = scene_of(wall);
    const auto planes = s.improved();
    for (std::size_t i = 0; i < s.pixels(); ++i) {
      ASSERT_TRUE(s.is_behind[i] || planes[0][i] == s.behind[0][i]) << i;
    }
  }
}

TEST_F(PatternPicture, NothingKnownOrNothingBehindChangesNothing) {
  Scene unknown = scene_of(bricks);
  for (std::uint32_t& v : unknown.encoded) v &= ~DEFRAY_PATTERN_KNOWN;
  EXPECT_EQ(unknown.improved(), unknown.behind);
  Scene whole = scene_of(bricks);
  whole.is_behind.assign(whole.pixels(), 0);
  EXPECT_EQ(whole.improved(), whole.behind);
}

TEST_F(PatternPicture, AConstantChannelStaysConstantBitForBit) {
  // Green varies, so that there is something to match.
  const auto wall = [](int x, int y, int c) { return c == 1 ? bricks(x, y, c) : 0.3f; };
  Scene s(picture);
  s.paint(wall, bar);
  for (const std::size_t c : {0, 2}) s.behind[c].assign(s.pixels(), 0.3f);
  const auto planes = s.improved();
  EXPECT_EQ(planes[0], s.behind[0]);
  EXPECT_EQ(planes[2], s.behind[2]);
  EXPECT_NE(planes[1], s.behind[1]);
}

TEST_F(PatternPicture, AConstantWallStaysConstantBitForBit) {
  Scene s(picture);
  s.paint([](int, int, int) { return 0.3f; }, bar);
  s.behind.assign(3, Plane(s.pixels(), 0.3f));
  EXPECT_EQ(s.improved(), s.behind);
}

TEST_F(PatternPicture, HighlightsAndNonsenseAreNotCopied) {
  for (const float outlier : {40.0f, 1.001f, -40.0f, HUGE_VALF, std::nanf("")}) {
    Scene s = scene_of(bricks);
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
  Scene s(picture);
  s.paint(wall, [](int x, int) { return x >= 95 && x < 104; });
  for (int y = 0; y < s.size.height; ++y) {
    for (int x = 104; x < s.size.width; ++x) s.coc[s.at(x, y)] = 1024;
  }
  const auto planes = s.improved();
  EXPECT_LT(s.error(planes, wall), 0.05 * s.error(s.behind, wall));
}

TEST(Patterns, TheWholeStageEqualsItsTwinOnAwkwardFrames) {
  std::vector<Size> sizes{{1, 1}, {1, 90}, {90, 1}, {3, 5}};
  if (!is_slow_device()) sizes.push_back({131, 67});
  for (const Size size : sizes) {
    Scene s(size);
    s.paint(bricks, [](int x, int y) { return x % 31 == 7 || y % 29 == 3; });
    auto twin = s.behind;
    reference::improve_by_patterns(s.frame(), s.channels, PatternSettings(), twin);
    EXPECT_EQ(hash_of(s.improved()), hash_of(twin)) << size.width << "x" << size.height;
  }
}

TEST(Patterns, VarianceIsThatOfTheWindow) {
  const Scene s = scene_of(noise, {110, 30});
  PatternSettings settings;
  settings.window_px = 5;
  const auto pixels = pattern_pixels(s.frame(), s.channels);
  const Plane variance = pattern_variance(s.frame(), pixels, settings);
  for (const auto& [px, py] : {std::pair{91, 15}, {90, 0}, {103, 29}, {94, 7}, {95, 7}}) {
    double n = 0, sum[3] = {}, squares = 0;
    for (int y = std::max(0, py - 4); y <= std::min(29, py + 4); ++y) {
      for (int x = std::max(0, px - 4); x <= std::min(109, px + 4); ++x) {
        const std::uint32_t v = pixels[s.at(x, y)];
        if (!(v & DEFRAY_PATTERN_KNOWN)) continue;
        const double w = (5 - std::abs(x - px)) * (5 - std::abs(y - py));
        n += w;
        for (int c = 0; c < 3; ++c) {
          const double value = v >> (8 * c) & 255;
          sum[c] += w * value;
          squares += w * value * value;
        }
      }
    }
    const double expected =
        n == 0 ? 0 : squares / n - (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (n * n);
    EXPECT_NEAR(variance[s.at(px, py)], expected, 1e-6 * expected) << px << " " << py;
  }
}

}  // namespace
}  // namespace defray::test
