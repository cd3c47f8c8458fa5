// `patterns`: the kernels against their twins.
#include "chain/patterns_window.h"
#include "patterns_scene.h"
#include "reference/reference.h"

namespace defray::test::patterns_test {
namespace {

/// Known pixels, fragments and radii for each pixel by itself; so large a share hides something.
PatternScene random_scene(Size size, double share) {
  PatternScene s(size);
  s.paint(noise, [](int, int) { return false; });
  for (std::size_t i = 0; i < s.pixels(); ++i) {
    Random random(static_cast<int>(i), 3, 5);
    s.is_behind[i] = random.next() < share || i == s.pixels() / 2;
    if (random.next() < 0.2) s.encoded[i] &= ~DEFRAY_PATTERN_KNOWN;
    s.coc[i] = static_cast<std::int32_t>(1000 * random.next());
    s.behind_coc[i] = static_cast<std::int32_t>(1000 * random.next());
    s.inverse[i] = static_cast<float>(random.next());
    s.behind_inverse[i] = static_cast<float>(random.next());
  }
  return s;
}

std::uint64_t hash_of_sums(const PatternSums& s) {
  std::vector<Plane> all = s.difference;
  all.push_back(s.weight);
  all.push_back(s.weighted_square);
  return hash_of(all);
}

const std::vector<PatternShift> some_shifts{{3, 1},    {-3, -1}, {0, 5},      {-40, 0},
                                            {1000, 3}, {0, 0},   {50, 0, 60}, {0, -30, 45}};

void expect_twins_bits(const PatternScene& s, PatternSettings settings) {
  const Size size = s.size;
  const std::uint64_t twin =
      hash_of_sums(twins().patterns(s.frame(), s.hidden(), s.words(), some_shifts, settings));
  const PatternMargins margins(some_shifts, settings.window_px);
  for (const int rows : {0, 1, 7, 64}) {
    if (rows == 1 && size.height > 50) continue;
    const InBands in_bands(session(), rows > 0 ? patterns_band_bytes(size.width, margins, rows)
                                               : default_memory_bytes);
    session().set_work_group(rows == 7 ? 3 : 0, rows == 7 ? 1 : 0);
    EXPECT_EQ(
        hash_of_sums(device().patterns(s.frame(), s.hidden(), s.words(), some_shifts, settings)),
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

TEST(Patterns, BandsTakeTheMemoryTheyAreReckonedWith) {
  const PatternScene s = random_scene({90, 120}, 0.3);
  const PatternSettings settings;
  const std::vector<PatternShift> shifts{{10, -20}, {0, 15}};
  const PatternMargins margins(shifts, settings.window_px);
  for (const int rows : {20, 60}) {
    const std::size_t given = patterns_band_bytes(90, margins, rows);
    const InBands in_bands(session(), given);
    const std::size_t before = session().traffic().made;
    device().patterns(s.frame(), s.hidden(), s.words(), shifts, settings);
    const auto made = static_cast<double>(session().traffic().made - before);
    const double reckoned = static_cast<double>(given) * 120 / rows;
    // The first and the last band have less above and below.
    EXPECT_LE(made / reckoned, 1) << rows;
    EXPECT_GT(made / reckoned, 0.85) << rows;
  }
}

TEST(Patterns, TheLargestWindowFullOfTheLargestDifferencesFits) {
  if (is_slow_device()) GTEST_SKIP() << "too large for a simulator";
  PatternScene s({100, 100});
  s.paint([](int x, int, int) { return x % 2 ? 1.0f : 0.0f; }, [](int, int) { return false; });
  s.is_behind.assign(s.pixels(), 1);
  PatternSettings settings;
  settings.window_px = DEFRAY_PATTERN_LARGEST_WINDOW;
  const PatternSums sums = device().patterns(s.frame(), s.hidden(), s.words(), {{1, 0}}, settings);
  const std::size_t middle = s.at(50, 50);
  EXPECT_NEAR(sums.weighted_square[middle] / sums.weight[middle], 3 * 255 * 255, 1);
  EXPECT_EQ(hash_of_sums(sums),
            hash_of_sums(twins().patterns(s.frame(), s.hidden(), s.words(), {{1, 0}}, settings)));
}

TEST(Patterns, TheWholeStageEqualsItsTwinOnAwkwardFrames) {
  std::vector<Size> sizes{{1, 1}, {1, 90}, {90, 1}, {3, 5}};
  if (!is_slow_device()) sizes.push_back({131, 67});
  for (const Size size : sizes) {
    PatternScene s(size);
    s.paint(bricks, [](int x, int y) { return x % 31 == 7 || y % 29 == 3; });
    EXPECT_EQ(hash_of(s.improved()), hash_of(s.improved(twins())))
        << size.width << "x" << size.height;
  }
}

TEST(Patterns, VarianceIsThatOfTheWindow) {
  // More rows than are worked out together.
  const PatternScene s = scene_of(noise, {110, 150});
  PatternSettings settings;
  settings.window_px = 5;
  const auto pixels = s.words();
  const Plane variance = patterns_variance(s.frame(), pixels, settings);
  for (const auto& [px, py] :
       {std::pair{91, 15}, {90, 0}, {103, 149}, {94, 127}, {95, 128}, {93, 7}}) {
    double n = 0, sum[3] = {}, squares = 0;
    for (int y = std::max(0, py - 4); y <= std::min(149, py + 4); ++y) {
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
}  // namespace defray::test::patterns_test
