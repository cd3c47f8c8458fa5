// Kernel rdb_scatter against its scalar twin, and the twin against the paper's definition.
#include "device/rdb_scatter.h"

#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "lens/lens_grid.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::rdb_scatter_test {
namespace {

/// CoC radii: none, below half a pixel, small, middling, past every frame, and the format's limit.
constexpr double radii[] = {0, 0.3, 1.7, 8, 32, 1000, 4194303};

/// The definition, word for word: of all source pixels p with x - p - r u in [-1/2, 1/2)^2 the
/// nearest, the one of the smallest radius, the first of equals. Integer numerators over 2^24.
std::int64_t winner_by_definition(Size size, int x, int y, std::array<std::int32_t, 2> u,
                                  const std::vector<std::int32_t>& coc) {
  std::int64_t best = -1;
  for (int py = 0; py < size.height; ++py) {
    for (int px = 0; px < size.width; ++px) {
      const auto p = static_cast<std::size_t>(py * size.width + px);
      const std::int64_t one = 1 << 24, half = one / 2;
      const std::int64_t dx = (x - px) * one - static_cast<std::int64_t>(coc[p]) * u[0];
      const std::int64_t dy = (y - py) * one - static_cast<std::int64_t>(coc[p]) * u[1];
      if (dx < -half || dx >= half || dy < -half || dy >= half) continue;
      if (best < 0 || coc[p] < coc[static_cast<std::size_t>(best)]) {
        best = static_cast<std::int64_t>(p);
      }
    }
  }
  return best;
}

/// One cell's winners over the frame as the device found them: source index, or -1.
using CellWinners = std::vector<std::vector<std::int64_t>>;

/// Every cell's winners, [cell][pixel], gathered from all passes; checks the keys beside them.
CellWinners winners_on_device(Session& s, Size size, const RdbSettings& settings,
                              const std::vector<std::int32_t>& coc, const Plane& depth) {
  const Frame frame{size.width, size.height, coc, depth, std::vector<Plane>{depth}};
  const RayPlan plan = plan_rays(settings);
  RdbScatter run(s, frame, plan);
  std::size_t outside = 0, of_other_coc = 0;
  CellWinners all(make_lens_grid(settings.cells_per_side, settings.jitter).points.size(),
                  std::vector<std::int64_t>(depth.size(), -2));
  for (const RdbPass& pass : run.passes()) {
    run.scatter(pass);
    const std::vector<RdbWinner> winners = run.winners(pass);
    const std::size_t band = winners.size() / static_cast<std::size_t>(pass.cell_count);
    const auto window = static_cast<std::int64_t>(run.first_source(pass));
    const std::int64_t first = std::int64_t{pass.y} * size.width;
    for (std::size_t i = 0; i < winners.size(); ++i) {
      const RdbWinner& w = winners[i];
      auto& found = all[i / band + static_cast<std::size_t>(pass.first_cell)]
                       [i % band + static_cast<std::size_t>(first)];
      found = w.source == DEFRAY_EMPTY ? -1 : window + w.source;
      if (found < 0) continue;
      if (found >= static_cast<std::int64_t>(depth.size())) {
        ++outside;
      } else {
        of_other_coc += w.key != coc[static_cast<std::size_t>(found)] + (std::int64_t{1} << 31);
      }
    }
  }
  EXPECT_EQ(outside, 0u) << "winners outside the frame";
  EXPECT_EQ(of_other_coc, 0u) << "winners whose key is not their CoC";
  return all;
}

/// Cells whose winner differs from the twin's, over a whole frame: with 64-bit atomics, and in the
/// two passes without them.
std::array<std::size_t, 2> differing_winners(Size size, const RdbSettings& settings,
                                             const std::vector<std::int32_t>& coc,
                                             const Plane& depth) {
  const RayPlan plan = plan_rays(settings);
  const std::array<CellWinners, 2> kernels{
      winners_on_device(session(), size, settings, coc, depth),
      winners_on_device(session_without_int64(), size, settings, coc, depth)};
  std::array<std::size_t, 2> differing{};
  for (std::size_t cell = 0; cell < kernels[0].size(); ++cell) {
    const auto twin = reference::rdb_scatter({size.width, size.height, coc, depth}, plan, cell);
    for (std::size_t i = 0; i < kernels.size(); ++i) {
      differing[i] +=
          twin == kernels[i][cell]
              ? 0
              : std::inner_product(twin.begin(), twin.end(), kernels[i][cell].begin(),
                                   std::size_t{0}, std::plus<>{}, std::not_equal_to<>{});
    }
  }
  return differing;
}

constexpr std::array<std::size_t, 2> none{};

int cells_per_side(Size size) {
  const int pixels = size.width * size.height;
  if (is_slow_device()) return pixels > 100000 ? 1 : pixels > 10000 ? 2 : 5;
  return pixels > 100000 ? 4 : 9;
}

void expect_no_differing_winners(bool jitter) {
  std::uint32_t seed = 1;
  for (const Size size : awkward_sizes()) {
    for (const double radius : radii) {
      // Jitter makes both visit every pixel in a ray's reach: large CoC in the smaller frames only.
      const int pixels = size.width * size.height;
      const bool is_largest = pixels > 25000;
      if (jitter && pixels > 10000 && radius > (is_largest ? 1.7 : 8)) continue;
      if (jitter && is_slow_device() && (is_largest || radius > 8)) continue;
      if (!takes_long_tests() && pixels > 10000 && radius > 2) continue;
      RdbSettings settings;
      settings.cells_per_side = cells_per_side(size);
      settings.jitter = jitter;
      settings.seed = seed;
      const auto coc = random_coc(size, radius, ++seed);
      const Plane depth = random_depth(size, ++seed);
      EXPECT_EQ(differing_winners(size, settings, coc, depth), none)
          << size.width << "x" << size.height << ", CoC up to " << radius << " px, seed " << seed;
    }
  }
}

TEST(RdbScatter, TwinIsTheDefinition) {
  std::uint32_t seed = 100;
  for (const Size size : {Size{1, 1}, Size{1, 17}, Size{13, 7}, Size{29, 23}}) {
    for (const double radius : radii) {
      const LensPoints lens = make_lens_grid(size.width > 20 ? 5 : 9, false);
      const auto coc = random_coc(size, radius, ++seed);
      const Plane depth = random_depth(size, ++seed);
      for (std::size_t cell = 0; cell < lens.points.size(); ++cell) {
        const auto twin =
            reference::rdb_scatter({size.width, size.height, coc, depth}, {lens}, cell);
        for (std::size_t i = 0; i < twin.size(); ++i) {
          const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
          ASSERT_EQ(twin[i], winner_by_definition(size, x, y, lens.points[cell], coc))
              << "cell " << cell << " of pixel (" << x << ", " << y << "), CoC up to " << radius;
        }
      }
    }
  }
}

TEST(RdbScatter, KernelsEqualTwin) { expect_no_differing_winners(false); }

TEST(RdbScatter, KernelsEqualTwinWithJitter) { expect_no_differing_winners(true); }

TEST(RdbScatter, EqualDepthsGoToTheSmallerIndex) {
  const Size size{33, 9};
  const Plane depth(33 * 9, 2.0f);
  const auto coc = random_coc(size, 6, 7);
  EXPECT_EQ(differing_winners(size, {}, coc, depth), none);
}

TEST(RdbScatter, BandsKeepTheWinners) {
  const Size size{61, 47};
  const Plane depth = random_depth(size, 8);
  const auto coc = random_coc(size, 6, 9);
  RdbSettings settings;
  settings.cells_per_side = 3;
  for (const std::size_t rows : {1, 2, 5, 46}) {
    const InBands in_bands(session(), rows * 61 * rdb_bytes_a_pixel(1));
    EXPECT_EQ(differing_winners(size, settings, coc, depth), none) << rows << " rows";
  }
}

TEST(RdbScatter, ZeroRadiusFillsEveryCellOfItsOwnPixel) {
  const Size size{13, 7};
  const std::vector<std::int32_t> coc(13 * 7, 0);
  for (const auto& cell : winners_on_device(session(), size, {}, coc, random_depth(size, 3))) {
    for (std::size_t i = 0; i < cell.size(); ++i) EXPECT_EQ(cell[i], static_cast<std::int64_t>(i));
  }
}

}  // namespace
}  // namespace defray::test::rdb_scatter_test
