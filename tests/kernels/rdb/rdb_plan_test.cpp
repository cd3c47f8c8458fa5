// Passes within a memory budget, and the cells of the lens.
#include "rdb/rdb_plan.h"

#include "lens/lens_grid.h"
#include "support.h"

namespace defray::test::rdb_plan_test {
namespace {

TEST(RdbPlan, CoversEveryRowAndCellOnceWithinTheBudget) {
  for (const int height : {1, 2, 97, 480}) {
    for (const std::size_t rows : {1, 2, 5, 1000}) {
      const std::size_t budget = rows * 100 * rdb_bytes_a_pixel(1);
      const auto passes = plan_rdb_passes(100, {0, height}, height, 69, 12, budget);
      std::vector<int> seen(static_cast<std::size_t>(height));
      for (const RdbPass& p : passes) {
        const std::size_t pixels = 100 * static_cast<std::size_t>(p.rows);
        EXPECT_LE(pixels * (8 * static_cast<std::size_t>(p.cell_count) + 24), budget);
        EXPECT_LE(p.window_y, std::max(0, p.y - 12));
        EXPECT_GE(p.window_y + p.window_rows, std::min(height, p.y + p.rows + 12));
        for (int y = p.y; y < p.y + p.rows; ++y) {
          seen[static_cast<std::size_t>(y)] += p.cell_count;
        }
      }
      for (const int cells : seen) EXPECT_EQ(cells, 69);
    }
  }
}

TEST(RdbPlan, APassFitsTheCacheUnlessItsRowsWouldBeLessThanFourTimesTheReach) {
  const std::size_t row = 1000 * rdb_bytes_a_pixel(1), cache = 16 << 20;
  for (const int reach : {2, 12, 200}) {
    for (const RdbPass& p :
         plan_rdb_passes(1000, {0, 4000}, 4000, 69, reach, std::size_t{1} << 32)) {
      const std::size_t pixels = 1000 * size(p.rows), cells = size(p.cell_count);
      const std::size_t bytes = pixels * rdb_bytes_a_pixel(cells);
      EXPECT_LE(bytes, std::max(cache, row * 4 * size(reach)));
      EXPECT_LE(size(p.rows), std::max(cache / row, 4 * size(reach)));
    }
  }
}

TEST(RdbPlan, SaysHowMuchMemoryOneRowNeeds) {
  const std::size_t row = 100 * rdb_bytes_a_pixel(1);
  expect_error(ErrorKind::usage,
               {"memory is 0.003814 MiB: one row of 100 pixels needs at least 0.004 MiB"}, [&] {
                 plan_rdb_passes(100, {0, 10}, 10, 69, 1, row - 1);
               });
  EXPECT_EQ(plan_rdb_passes(100, {0, 10}, 10, 69, 1, row).size(), 690u);
  EXPECT_NO_THROW(plan_rdb_passes(100, {0, 10}, 10, 69, 1, 0.004 * 1048576));
}

TEST(LensPoints, RoundApertureOfThePaper) {
  EXPECT_EQ(make_lens_grid(9, false).points.size(), 69u);
  EXPECT_EQ(make_lens_grid(1, false).points.size(), 1u);
  EXPECT_EQ(make_lens_grid(2, false).points.size(), 4u);
  // pi/4 of the square, as the cells get small.
  EXPECT_NEAR(make_lens_grid(64, false).points.size() / 4096.0, 0.785398, 0.005);
  for (const int n : {0, -1, 65}) {
    expect_error(ErrorKind::usage, {"cells_per_side", "1 to 64"},
                 [n] { make_lens_grid(n, false); });
  }
}

TEST(LensPoints, AreCentredOnTheAxis) {
  for (int n = 1; n <= 64; ++n) {
    std::int64_t u = 0, v = 0;
    for (const auto& cell : make_lens_grid(n, false).points) u += cell[0], v += cell[1];
    EXPECT_EQ(u, 0) << n;
    EXPECT_EQ(v, 0) << n;
  }
}

}  // namespace
}  // namespace defray::test::rdb_plan_test
