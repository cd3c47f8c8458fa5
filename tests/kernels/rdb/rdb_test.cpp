// The whole ray distribution buffer: means against the twin, and the bits that must never change.
#include <cmath>
#include <limits>

#include "faults/fault.h"
#include "lens/lens_grid.h"
#include "rdb/rdb_plan.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::rdb_test {
namespace {

// What a frame is made of for the tests of the whole stage.
struct Input {
  Size size;
  std::vector<std::int32_t> coc;
  Plane depth;
  std::vector<Plane> channels;
};

Input make_input(Size size, double radius, std::uint32_t seed) {
  Input in{size, random_coc(size, radius, seed), random_depth(size, seed + 1), {}};
  for (std::uint32_t c = 0; c < 4; ++c) in.channels.push_back(random_plane(size, seed + 2 + c));
  return in;
}

std::vector<Plane> render(Session& s, const Input& in, const RdbSettings& settings) {
  return DeviceBackend(s)
      .rays({in.size.width, in.size.height, in.coc, in.depth, in.channels}, plan_rays(settings))
      .means;
}

RdbSettings small_settings(bool jitter = false) {
  RdbSettings settings;
  settings.cells_per_side = is_slow_device() ? 3 : 7;
  settings.jitter = jitter;
  settings.seed = 11;
  return settings;
}

/// A frame of several work-groups and bands, as large as the device can bear.
Size frame_size() { return is_slow_device() ? Size{37, 23} : Size{131, 97}; }

TEST(Rdb, MeansEqualTheTwinsBitForBitAndTheExactOnesWithinTheBoundOfFloatSums) {
  for (const bool jitter : {false, true}) {
    const Input in = make_input({67, 41}, 6, 21);
    const RdbSettings settings = small_settings(jitter);
    const auto kernel = render(session(), in, settings);
    const auto twin =
        twins().rays({67, 41, in.coc, in.depth, in.channels}, plan_rays(settings)).means;
    EXPECT_EQ(hash_of(kernel), hash_of(twin));
    const auto exact =
        reference::exact_rays({67, 41, in.coc, in.depth, in.channels}, plan_rays(settings));
    const double cells =
        static_cast<double>(make_lens_grid(settings.cells_per_side, jitter).points.size());
    for (std::size_t c = 0; c < 4; ++c) {
      double largest = 0;
      for (const float v : in.channels[c]) largest = std::fmax(largest, std::fabs(v));
      // n - 1 additions to sums <= n L, each rounded, one division and the kernel's 2.5 ulp for it
      // at worst; u = 2^-24: |error| <= (n n L u) / n + 5 L u.
      const double bound = (cells + 5) * largest * 0x1p-24;
      for (std::size_t i = 0; i < exact[c].size(); ++i) {
        ASSERT_NEAR(kernel[c][i], exact[c][i], bound) << "channel " << c << ", pixel " << i;
      }
    }
  }
}

TEST(Rdb, SameBitsForEveryMemoryBudget) {
  const Size size = is_slow_device() ? Size{11, 37} : Size{131, 37};
  const Input in = make_input(size, 9, 31);
  for (const bool jitter : {false, true}) {
    RdbSettings settings = small_settings(jitter);
    settings.cells_per_side = 3;
    const std::uint64_t whole = hash_of(render(session(), in, settings));
    const std::size_t row = size.width * rdb_bytes_a_pixel(1);  // one row of one cell with its sums
    for (const std::size_t bytes : {row, 2 * row, 3 * row + 100, 17 * row, 36 * row}) {
      const InBands in_bands(session(), bytes), too(session_without_int64(), bytes);
      EXPECT_EQ(hash_of(render(session(), in, settings)), whole) << bytes << " bytes";
      EXPECT_EQ(hash_of(render(session_without_int64(), in, settings)), whole) << bytes << " bytes";
    }
  }
}

TEST(Rdb, SameBitsForEveryWorkGroup) {
  SKIP_UNLESS_FULL();
  const Input in = make_input(frame_size(), 9, 41);
  Session s(device_under_test());
  const std::uint64_t expected = hash_of(render(s, in, small_settings()));
  const std::size_t groups[][2] = {{1, 1}, {7, 3}, {16, 16}, {256, 1}, {1, 64}};
  for (const auto& group : groups) {
    s.set_work_group(group[0], group[1]);
    EXPECT_EQ(hash_of(render(s, in, small_settings())), expected) << group[0] << "x" << group[1];
  }
}

TEST(Rdb, SameBitsInTwentyRuns) {
  const Input in = make_input(frame_size(), 9, 51);
  const RdbSettings settings = small_settings(true);
  const std::uint64_t first = hash_of(render(session(), in, settings));
  for (int run = 1; run < (is_slow_device() ? 3 : 20); ++run) {
    EXPECT_EQ(hash_of(render(session(), in, settings)), first) << "run " << run;
  }
}

TEST(Rdb, JitterAndSeedChangeThePicture) {
  const Input in = make_input({41, 29}, 6, 61);
  RdbSettings settings = small_settings();
  const std::uint64_t plain = hash_of(render(session(), in, settings));
  settings.jitter = true;
  const std::uint64_t jittered = hash_of(render(session(), in, settings));
  settings.seed = 12;
  EXPECT_NE(plain, jittered);
  EXPECT_NE(jittered, hash_of(render(session(), in, settings)));
}

TEST(Rdb, OneColourStaysThatColourBitForBit) {
  Input in = make_input({61, 33}, 9, 72);
  for (Plane& plane : in.channels) plane.assign(plane.size(), 0.1f);
  EXPECT_EQ(hash_of(render(session(), in, small_settings())), hash_of(in.channels));
}

TEST(Rdb, ClosedApertureReturnsTheInputBitForBit) {
  Input in = make_input({61, 33}, 0, 71);
  std::fill(in.coc.begin(), in.coc.end(), 0);
  EXPECT_EQ(hash_of(render(session(), in, small_settings())), hash_of(in.channels));
}

TEST(Rdb, ClosedApertureKeepsInfinityAndMinusZero) {
  Input in = make_input({9, 7}, 0, 71);
  std::fill(in.coc.begin(), in.coc.end(), 0);
  in.channels[0][5] = std::numeric_limits<float>::infinity();
  in.channels[1][6] = -0.0f;
  EXPECT_EQ(hash_of(render(session(), in, small_settings())), hash_of(in.channels));
  EXPECT_EQ(
      hash_of(
          twins().rays({9, 7, in.coc, in.depth, in.channels}, plan_rays(small_settings())).means),
      hash_of(in.channels));
}

TEST(Rdb, FewerChannelsGiveTheSamePlanes) {
  Input in = make_input({31, 19}, 4, 81);
  const auto four = render(session(), in, small_settings());
  in.channels.resize(1);
  const auto one = render(session(), in, small_settings());
  EXPECT_EQ(one.size(), 1u);
  EXPECT_EQ(hash_of(one), hash_of({four[0]}));
}

/// Rows [first, first + rows) of a frame whose every value is a formula of its place.
Input formula_rows(int width, int first, int rows) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  Input in{{width, rows}, std::vector<std::int32_t>(pixels), Plane(pixels), {Plane(pixels)}};
  // Without vectors' functions: a hundred million pixels, and tests are not optimised.
  std::int32_t* coc = in.coc.data();
  float *depth = in.depth.data(), *channel = in.channels[0].data();
  for (int y = first; y < first + rows; ++y) {
    for (int x = 0; x < width; ++x) {
      const int block = (x / 64 + y / 48) % 5;
      *coc++ = 256 * (block - 2) * 5;
      *depth++ = 1.0f + static_cast<float>(block);
      *channel++ = static_cast<float>((x * 7 + y * 13) % 101);
    }
  }
  return in;
}

TEST(Rdb, HugeFrameInBandsEqualsItsParts) {
  SKIP_UNLESS_FULL();
  if (is_slow_device()) GTEST_SKIP() << "134 million pixels";
  constexpr int width = 16384, height = 8192, reach = 11, rows = 40;
  RdbSettings settings;
  settings.cells_per_side = 2;
  const Plane whole = render(session(), formula_rows(width, 0, height), settings)[0];
  for (const int first : {1000, 4096, 8100}) {
    const Input part = formula_rows(width, first - reach, rows + 2 * reach);
    const Plane expected = render(session(), part, settings)[0];
    const auto begin = [](const Plane& plane, int row) {
      return plane.begin() + std::int64_t{row} * width;
    };
    EXPECT_TRUE(
        std::equal(begin(expected, reach), begin(expected, reach + rows), begin(whole, first)))
        << "rows from " << first;
  }
}

const FaultRows faults{
    {"rdb_merge", "behind by radii of their own", {"radius = span_of(all,", "span_of(all,"}},
    {"rdb_merge", "made-up fragments count as seen", {"1u - (coverage[s] >> 31)", "1u"}},
    {"rdb_merge", "count begun anew with each pass", {"? 0u : seen[target]", "? 0u : 0u"}},
    {"rdb_merge",
     "stale sums from the band before",
     {"p.is_first_pass ? (float4)(0.0f) : colour_at(CHANNELS(sum), target)",
      "colour_at(CHANNELS(sum), target)"}},
    {"rdb_merge",
     "sums not begun at zero, without bands",
     {"p.is_first_pass ? (float4)(0.0f) : colour_at(CHANNELS(sum), target)",
      "p.is_first_pass && !p.is_last_pass ? (float4)(0.0f) : colour_at(CHANNELS(sum), target)"}},
    {"rdb_merge",
     "truncated sum: last cell of a pass",
     {"cell < p.cell_count; ++cell", "cell + 1 < p.cell_count; ++cell"}},
    {"rdb_merge",
     "mean over empty cells too",
     {"total / (float)max(count, 1u)", "total / (float)p.cell_count"}},
    {"rdb_merge",
     "differences forgotten between passes",
     {"bool differs = state != count;", "bool differs = false;"}},
    {"rdb_merge",
     "own pixel from the wrong row",
     {"(size_t)(p.band_y - p.window_y + row)", "(size_t)(row)"}},
    {"rdb_merge",
     "-0 becomes +0",
     {"differs ? total / (float)max(count, 1u) : own", "total / (float)max(count, 1u)"}},
    {"rdb_merge", "nothing shows through", {"held == DEFRAY_EMPTY ? behind : held", "held"}},
    {"rdb_merge",
     "what has no share shows through",
     {"(coverage[i] & ~DEFRAY_SYNTHESISED) == 0u", "false"}},
    {"rdb_merge",
     "what is in front does not show through",
     {"layer == 0 && found == DEFRAY_EMPTY", "layer == 0"}},
    {"rdb_merge",
     "something shows through where nothing is behind",
     {"layer == 0 && found == DEFRAY_EMPTY", "false"}},
    {"rdb_merge", "the nearest behind", {"radius <= farthest", "radius >= farthest"}},
};

}  // namespace
}  // namespace defray::test::rdb_test
