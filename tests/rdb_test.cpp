// Kernels rdb_scatter and rdb_merge against their scalar twins, and the twins against the paper.
#include "rdb.h"

#include <cmath>
#include <cstring>
#include <random>

#include "reference/reference.h"
#include "support.h"

namespace defray::test {
namespace {

/// CoC radii: none, below half a pixel, small, middling, past every frame, and the format's limit.
constexpr double radii[] = {0, 0.3, 1.7, 8, 32, 1000, 4194303};

/// The definition, word for word: of all source pixels p with x - p - r u in [-1/2, 1/2)^2 the
/// nearest, the first of equals. Integer numerators over 2^24.
std::int64_t winner_by_definition(Size size, int x, int y, std::array<std::int32_t, 2> u,
                                  const std::vector<std::int32_t>& coc, const Plane& depth) {
  std::int64_t best = -1;
  for (int py = 0; py < size.height; ++py) {
    for (int px = 0; px < size.width; ++px) {
      const auto p = static_cast<std::size_t>(py * size.width + px);
      const std::int64_t one = 1 << 24, half = one / 2;
      const std::int64_t dx = (x - px) * one - static_cast<std::int64_t>(coc[p]) * u[0];
      const std::int64_t dy = (y - py) * one - static_cast<std::int64_t>(coc[p]) * u[1];
      if (dx < -half || dx >= half || dy < -half || dy >= half) continue;
      if (best < 0 || depth[p] < depth[static_cast<std::size_t>(best)]) {
        best = static_cast<std::int64_t>(p);
      }
    }
  }
  return best;
}

/// One cell's winners over the frame as the device found them: source index, or -1.
using CellWinners = std::vector<std::vector<std::int64_t>>;

/// Every cell's winners, [cell][pixel], gathered from all passes; checks the depths beside them.
CellWinners winners_on_device(Session& s, Size size, const RdbSettings& settings,
                              const std::vector<std::int32_t>& coc, const Plane& depth) {
  const std::vector<Plane> channels{depth};
  RdbRun run(s, size.width, size.height, coc, depth, channels, settings);
  CellWinners all(make_lens_cells(settings.cells_per_side, settings.jitter).centres.size(),
                  std::vector<std::int64_t>(depth.size(), -2));
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    const std::vector<RdbWinner> winners = run.winners(pass);
    const std::size_t band = winners.size() / static_cast<std::size_t>(pass.cell_count);
    const std::int64_t window = std::int64_t{pass.window_y} * size.width;
    const std::int64_t first = std::int64_t{pass.band_y} * size.width;
    for (std::size_t i = 0; i < winners.size(); ++i) {
      const RdbWinner& w = winners[i];
      auto& found = all[i / band + static_cast<std::size_t>(pass.first_cell)]
                       [i % band + static_cast<std::size_t>(first)];
      found = w.source == DEFRAY_EMPTY ? -1 : window + w.source;
      if (found < 0) continue;
      std::uint32_t bits;
      std::memcpy(&bits, &depth[static_cast<std::size_t>(found)], sizeof(bits));
      EXPECT_EQ(w.depth_bits, bits);
    }
  }
  return all;
}

/// Cells whose winner differs between kernel and twin, over a whole frame.
std::size_t differing_winners(Session& s, Size size, const RdbSettings& settings,
                              const std::vector<std::int32_t>& coc, const Plane& depth) {
  const LensCells cells = make_lens_cells(settings.cells_per_side, settings.jitter);
  const CellWinners kernel = winners_on_device(s, size, settings, coc, depth);
  std::size_t differing = 0;
  for (std::size_t cell = 0; cell < kernel.size(); ++cell) {
    const auto twin =
        reference::rdb_scatter(size.width, size.height, cells, cell, settings.seed, coc, depth);
    for (std::size_t i = 0; i < twin.size(); ++i) differing += kernel[cell][i] != twin[i];
  }
  return differing;
}

int cells_a_side(Size size) {
  const int pixels = size.width * size.height;
  if (is_slow_device()) return pixels > 100000 ? 1 : pixels > 10000 ? 2 : 5;
  return pixels > 100000 ? 4 : 9;
}

void expect_no_differing_winners(Session& s, bool jitter) {
  std::uint32_t seed = 1;
  for (const Size size : awkward_sizes()) {
    for (const double radius : radii) {
      if (is_slow_device() && size.width == 640 && radius != 8) continue;
      // Jitter makes both visit every pixel in a ray's reach: large CoC in the smaller frames only.
      if (jitter && size.width > 100 && radius > (size.width > 300 ? 8 : 32)) continue;
      if (jitter && is_slow_device() && (size.width > 300 || radius > 8)) continue;
      RdbSettings settings;
      settings.cells_per_side = cells_a_side(size);
      settings.jitter = jitter;
      settings.seed = seed;
      const auto coc = random_coc(size, radius, ++seed);
      const Plane depth = random_depth(size, ++seed);
      EXPECT_EQ(differing_winners(s, size, settings, coc, depth), 0u)
          << size.width << "x" << size.height << ", CoC up to " << radius << " px, seed " << seed;
    }
  }
}

TEST(RdbScatter, TwinIsTheDefinition) {
  std::uint32_t seed = 100;
  for (const Size size : {Size{1, 1}, Size{1, 17}, Size{13, 7}, Size{29, 23}}) {
    for (const double radius : radii) {
      const LensCells cells = make_lens_cells(size.width > 20 ? 5 : 9, false);
      const auto coc = random_coc(size, radius, ++seed);
      const Plane depth = random_depth(size, ++seed);
      for (std::size_t cell = 0; cell < cells.centres.size(); ++cell) {
        const auto twin =
            reference::rdb_scatter(size.width, size.height, cells, cell, 0, coc, depth);
        for (std::size_t i = 0; i < twin.size(); ++i) {
          const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
          ASSERT_EQ(twin[i], winner_by_definition(size, x, y, cells.centres[cell], coc, depth))
              << "cell " << cell << " of pixel (" << x << ", " << y << "), CoC up to " << radius;
        }
      }
    }
  }
}

TEST(RdbScatter, KernelEqualsTwin) { expect_no_differing_winners(session(), false); }

TEST(RdbScatter, KernelEqualsTwinWithJitter) { expect_no_differing_winners(session(), true); }

TEST(RdbScatter, TwoPassFallbackEqualsTwin) {
  expect_no_differing_winners(session_without_int64(), false);
}

TEST(RdbScatter, TwoPassFallbackEqualsTwinWithJitter) {
  expect_no_differing_winners(session_without_int64(), true);
}

TEST(RdbScatter, EqualDepthsGoToTheSmallerIndex) {
  const Size size{33, 9};
  const Plane depth(33 * 9, 2.0f);
  const auto coc = random_coc(size, 6, 7);
  EXPECT_EQ(differing_winners(session(), size, {}, coc, depth), 0u);
  EXPECT_EQ(differing_winners(session_without_int64(), size, {}, coc, depth), 0u);
}

TEST(RdbScatter, BandsKeepTheWinners) {
  const Size size{61, 47};
  const Plane depth = random_depth(size, 8);
  const auto coc = random_coc(size, 6, 9);
  RdbSettings settings;
  settings.cells_per_side = 3;
  for (const std::size_t rows : {1, 2, 5, 46}) {
    settings.memory_bytes = rows * 61 * 32;
    EXPECT_EQ(differing_winners(session(), size, settings, coc, depth), 0u) << rows << " rows";
  }
}

TEST(RdbScatter, ZeroRadiusFillsEveryCellOfItsOwnPixel) {
  const Size size{13, 7};
  const std::vector<std::int32_t> coc(13 * 7, 0);
  for (const auto& cell : winners_on_device(session(), size, {}, coc, random_depth(size, 3))) {
    for (std::size_t i = 0; i < cell.size(); ++i) EXPECT_EQ(cell[i], static_cast<std::int64_t>(i));
  }
}

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
  return render_rdb(s, in.size.width, in.size.height, in.coc, in.depth, in.channels, settings);
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

TEST(Rdb, MeansEqualTheTwinsWithinTheBoundOfFloatSums) {
  for (const bool jitter : {false, true}) {
    const Input in = make_input({67, 41}, 6, 21);
    const RdbSettings settings = small_settings(jitter);
    const auto kernel = render(session(), in, settings);
    const auto twin = reference::render_rdb(67, 41, in.coc, in.depth, in.channels, settings);
    const double cells =
        static_cast<double>(make_lens_cells(settings.cells_per_side, jitter).centres.size());
    for (std::size_t c = 0; c < 4; ++c) {
      double largest = 0;
      for (const float v : in.channels[c]) largest = std::fmax(largest, std::fabs(v));
      // n differences <= 2 L in size, each rounded and added to sums <= 2 n L, one division, one
      // addition of L, and the twin's own rounding to float; u = 2^-24:
      // |error| <= (n 2 L u + n 2 n L u) / n + 2 L u + 2 L u + L u = (2 n + 7) L u.
      const double bound = (2 * cells + 7) * largest * 0x1p-24;
      for (std::size_t i = 0; i < twin[c].size(); ++i) {
        ASSERT_NEAR(kernel[c][i], twin[c][i], bound) << "channel " << c << ", pixel " << i;
      }
    }
  }
}

TEST(Rdb, SameBitsForEveryMemoryBudget) {
  const Input in = make_input({131, 37}, 9, 31);
  for (const bool jitter : {false, true}) {
    RdbSettings settings = small_settings(jitter);
    settings.cells_per_side = 3;
    const std::uint64_t whole = hash_of(render(session(), in, settings));
    const std::size_t row = 131 * 32;  // one row of one cell with its sums
    for (const std::size_t bytes : {row, 2 * row, 3 * row + 100, 17 * row, 36 * row}) {
      settings.memory_bytes = bytes;
      EXPECT_EQ(hash_of(render(session(), in, settings)), whole) << bytes << " bytes";
      EXPECT_EQ(hash_of(render(session_without_int64(), in, settings)), whole) << bytes << " bytes";
    }
  }
}

TEST(Rdb, SameBitsForEveryWorkGroup) {
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
  Input in{{width, rows}, {}, {}, {{}}};
  for (int y = first; y < first + rows; ++y) {
    for (int x = 0; x < width; ++x) {
      const int block = (x / 64 + y / 48) % 5;
      in.coc.push_back(256 * (block - 2) * 5);
      in.depth.push_back(1.0f + static_cast<float>(block));
      in.channels[0].push_back(static_cast<float>((x * 7 + y * 13) % 101));
    }
  }
  return in;
}

TEST(Rdb, HugeFrameInBandsEqualsItsParts) {
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

TEST(RdbPlan, CoversEveryRowAndCellOnceWithinTheBudget) {
  for (const int height : {1, 2, 97, 480}) {
    for (const std::size_t rows : {1, 2, 5, 1000}) {
      const std::size_t budget = rows * 100 * 32;
      const auto passes = plan_rdb_passes(100, height, 69, 12, budget);
      std::vector<int> seen(static_cast<std::size_t>(height));
      for (const RdbPass& p : passes) {
        const std::size_t pixels = 100 * static_cast<std::size_t>(p.band_rows);
        EXPECT_LE(pixels * (8 * static_cast<std::size_t>(p.cell_count) + 24), budget);
        EXPECT_LE(p.window_y, std::max(0, p.band_y - 12));
        EXPECT_GE(p.window_y + p.window_rows, std::min(height, p.band_y + p.band_rows + 12));
        for (int y = p.band_y; y < p.band_y + p.band_rows; ++y) {
          seen[static_cast<std::size_t>(y)] += p.cell_count;
        }
      }
      for (const int cells : seen) EXPECT_EQ(cells, 69);
    }
  }
}

TEST(RdbPlan, SaysHowMuchMemoryOneRowNeeds) {
  expect_error(2, {"--memory", "3200"}, [] { plan_rdb_passes(100, 10, 69, 1, 3199); });
}

TEST(LensCells, RoundApertureOfThePaper) {
  EXPECT_EQ(make_lens_cells(9, false).centres.size(), 69u);
  EXPECT_EQ(make_lens_cells(1, false).centres.size(), 1u);
  EXPECT_EQ(make_lens_cells(2, false).centres.size(), 4u);
  // pi/4 of the square, as the cells get small.
  EXPECT_NEAR(make_lens_cells(64, false).centres.size() / 4096.0, 0.785398, 0.005);
  for (const int n : {0, -1, 65}) {
    expect_error(2, {"--rdb", "1 to 64"}, [n] { make_lens_cells(n, false); });
  }
}

TEST(LensCells, AreCentredOnTheAxis) {
  for (int n = 1; n <= 64; ++n) {
    std::int64_t u = 0, v = 0;
    for (const auto& cell : make_lens_cells(n, false).centres) u += cell[0], v += cell[1];
    EXPECT_EQ(u, 0) << n;
    EXPECT_EQ(v, 0) << n;
  }
}

}  // namespace
}  // namespace defray::test
