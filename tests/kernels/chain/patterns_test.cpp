// `patterns`: the kernels against their twins.
#include "chain/patterns/patterns_cells.h"
#include "opencl/launch_table.h"
#include "patterns_scene.h"

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

const std::vector<PatternShift> some_shifts{{3, 1, 0, 900},    {-3, -1, 0, 900}, {0, 5, 0, 12.5f},
                                            {-40, 0, 0, 4000}, {1000, 3},        {0, 0},
                                            {50, 0, 60, 0.1f}, {0, -30, 45, 300}};

/// Colours behind, moved.
std::uint64_t moved(const PatternScene& s, Backend& backend, const PatternSettings& settings,
                    const std::vector<PatternShift>& shifts = some_shifts) {
  const Frame frame = s.frame();
  const Values<float> variance = patterns_variance(frame, s.hidden(), s.words(), settings);
  const Frame behind = backend.patterns(frame, s.hidden(), s.words(), variance, shifts, settings);
  std::vector<Plane> planes;
  for (const auto& channel : behind.channels) planes.emplace_back(channel.begin(), channel.end());
  return hash_of(planes);
}

void expect_twins_bits(const PatternScene& s, const PatternSettings& settings) {
  const std::uint64_t twin = moved(s, twins(), settings);
  for (const int rows : {0, 1, 7, 64}) {
    if (rows == 1 && s.size.height > 50) continue;
    // As on a device with memory of its own: shifts and windows reach from band to band.
    const std::size_t row = size(s.size.width) * launch_of("patterns_match").bytes_a_surface;
    const InBands in_bands(session(), rows > 0 ? size(rows) * row : default_memory_bytes);
    session().set_work_group(rows == 7 ? 3 : 0, rows == 7 ? 1 : 0);
    EXPECT_EQ(moved(s, device(), settings), twin)
        << s.size.width << "x" << s.size.height << ", window " << settings.window_cells << ", rows "
        << rows;
  }
  session().set_work_group(0, 0);
}

TEST(Patterns, KernelsEqualTwinsBitForBitWhateverBandsAndWorkGroups) {
  for (const Size size : awkward_sizes()) {
    if (is_slow_device() && size.width * size.height > 400) continue;
    for (const double share : {0.3, 0.002}) {
      for (const int window_cells : {1, 2, 4, 6}) {
        if (is_slow_device() && window_cells > 2) continue;
        PatternSettings settings;
        settings.window_cells = window_cells;
        expect_twins_bits(random_scene(size, share), settings);
      }
    }
  }
}

TEST(Patterns, WithoutShiftsNothingMoves) {
  const PatternScene s = random_scene({40, 23}, 0.3);
  for (Backend* backend : device_and_twins()) {
    EXPECT_EQ(moved(s, *backend, {}, {}), hash_of(s.behind));
  }
}

TEST(Patterns, DifferencesTakeNoMoreThanTheMemory) {
  if (!session().works_in_host_memory()) GTEST_SKIP() << "planes are made on the device as well";
  const PatternScene s = random_scene({90, 120}, 0.3);
  const PatternSettings settings;
  // 6 units and 6 at their sides, of 16 bytes, a row of cells and a shift; windows reach 5 rows.
  const std::size_t row = some_shifts.size() * 12 * 16;
  for (const std::size_t rows : {11, 20}) {
    session().set_memory(rows * row);
    const std::size_t before = session().traffic().made;
    moved(s, device(), settings);
    EXPECT_EQ(session().traffic().made - before, rows * row);
  }
  session().set_memory(default_memory_bytes);
}

TEST(Patterns, TheLargestWindowFullOfTheLargestDifferencesFits) {
  if (is_slow_device()) GTEST_SKIP() << "too large for a simulator";
  PatternScene s({100, 100});
  s.paint([](int x, int, int) { return x % 2 ? 1.0f : 0.0f; }, [](int, int) { return false; });
  s.is_behind.assign(s.pixels(), 1);
  for (Plane& channel : s.behind) channel.assign(s.pixels(), 0.5f);
  PatternSettings settings;
  settings.window_cells = DEFRAY_PATTERN_LARGEST_WINDOW;
  // D = 3 x 255^2 = V: half of the variance is explained, and half of the way is gone.
  const Plane variance(size(pattern_rows(100) * pattern_units(100)) * DEFRAY_PATTERN_UNIT,
                       3 * 255 * 255);
  for (Backend* backend : device_and_twins()) {
    const Frame behind = backend->patterns(s.frame(), s.hidden(), s.words(), variance,
                                           {{1, 0, 0, 3 * 255 * 255}}, settings);
    for (const int x : {50, 51}) {
      EXPECT_NEAR(behind.channels[0][s.at(x, 50)], x % 2 ? 0.25 : 0.75, 1e-5);
    }
  }
}

/// How far a colour moves towards matches 0.6 away whose surroundings differ by D = 3 x 10^2, the
/// frame by `frame_square`.
double way_moved(Backend& backend, double variance, float frame_square = 300) {
  PatternScene s({64, 48});
  s.paint([](int x, int, int) { return x < 32 ? 0.3f : 0.9f; }, [](int, int) { return false; });
  for (std::size_t i = 0; i < s.pixels(); ++i) {
    s.encoded[i] = DEFRAY_PATTERN_KNOWN | (i % 64 < 32 ? 0x646464u : 0x6e6e6eu);
    s.is_behind[i] = i % 64 < 32;
  }
  for (Plane& channel : s.behind) channel.assign(s.pixels(), 0.3f);
  const Plane spread(size(pattern_rows(48) * pattern_units(64)) * DEFRAY_PATTERN_UNIT,
                     static_cast<float>(variance));
  const Frame behind =
      backend.patterns(s.frame(), s.hidden(), s.words(), spread, {{32, 0, 0, frame_square}}, {});
  return behind.channels[1][s.at(13, 21)] - 0.3f;
}

TEST(Patterns, ColoursMoveByTheShareOfTheVarianceThatMatchesExplain) {
  constexpr double difference = 300 + 0.65025;
  for (Backend* backend : device_and_twins()) {
    // D = 2 (V - covariance): hardly explained, half of it, nearly all.
    for (const double explained : {0.01, 0.25, 0.5, 0.99}) {
      const double variance = difference / 2 / (1 - explained);
      EXPECT_NEAR(way_moved(*backend, variance), 0.6 * explained, 1e-5);
    }
    EXPECT_EQ(way_moved(*backend, difference / 3), 0);
    EXPECT_EQ(way_moved(*backend, 0), 0);
  }
}

TEST(Patterns, TheFramesDifferenceCountsBesideThePairsOfTheWindow) {
  const int n = PatternSettings().window_cells;
  double pairs = 0;  // of way_moved's pixel, by weight
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 32; ++x) {
      pairs +=
          std::max(0, n - std::abs(x / 4 - 13 / 4)) * std::max(0, n - std::abs(y / 4 - 21 / 4));
    }
  }
  const double of_frame = frame_pairs(n);
  for (Backend* backend : device_and_twins()) {
    for (const float frame_square : {0.0f, 5000.0f, 20000.0f}) {
      const double square = (300 * pairs + of_frame * frame_square) / (pairs + of_frame) + 0.65025;
      EXPECT_NEAR(way_moved(*backend, 400, frame_square), 0.6 * (1 - square / 800), 1e-5);
    }
  }
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

}  // namespace
}  // namespace defray::test::patterns_test
