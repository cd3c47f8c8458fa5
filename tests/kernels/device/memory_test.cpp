// `--memory` is kept: what the launch table says of bands is what they take.
#include <algorithm>

#include "kernels/chain/stages_support.h"
#include "opencl/bands.h"
#include "opencl/launch_table.h"
#include "rdb/rdb.h"
#include "rdb/rdb_plan.h"

namespace defray::test::memory_test {
namespace {

/// Tall, so that a band's own rows count for more than those around it.
Frame tall_frame() {
  Canvas f(40, 600);
  f.coc.assign(f.count(), 2 * 256);
  f.each([&](int x, int y) { f.paint(x, y, static_cast<float>(x + y), 1, 2); });
  f.add_bar(15, 25);
  Frame frame = f.view();
  frame.coverage = Words(std::vector<std::uint32_t>(f.count(), DEFRAY_WHOLE));
  return frame;
}

Frame tall_frame_with_depth() {
  Frame frame = tall_frame();
  frame.depth = Plane(frame.pixels(), 2.0f);
  return frame;
}

struct Stage {
  std::string kernel;
  int reach_px;  ///< Of the discs of 2 px, beyond the launch table's.
  int step;
  std::function<void()> run;
};

TEST(Memory, BandsTakeWhatTheLaunchTableSays) {
  const Frame frame = tall_frame(), deep = tall_frame_with_depth();
  const Words mixed = device().mixed(frame);
  const Frame behind = device().fill(frame, mixed, DEFRAY_FILL_DIRECTIONS);
  const std::vector<Stage> stages = {
      {"repair", 0, 1, [&] { device().repair(deep); }},
      {"mixed", 0, 1, [&] { device().mixed(frame); }},
      {"fill", 4, DEFRAY_FILL_TILE, [&] { device().fill(frame, mixed, DEFRAY_FILL_DIRECTIONS); }},
      {"feather", 0, 1, [&] { device().feather(behind, behind.coc_quanta, mixed, mixed); }},
      {"split", 0, 1, [&] { device().split(frame, mixed, behind); }},
      {"highlights", 6, DEFRAY_HIGHLIGHT_TILE, [&] { device().highlights(frame, 3); }},
      {"soften", 0, 1, [&] { device().soften(frame, 100); }},
  };
  for (const Stage& stage : stages) {
    const Launch& launch = launch_of(stage.kernel);
    const std::size_t layers = stage.kernel == "split" ? 2 : 1;
    const std::size_t row_bytes = 40 * layers * launch.bytes_a_surface, given = 200 * row_bytes;
    std::size_t rows = 0;
    for (const BandRows& band : cut_into_windows({0, 600}, 600, launch.reach_px + stage.reach_px,
                                                 stage.step, {row_bytes}, given)) {
      rows += static_cast<std::size_t>(band.window_rows);
    }
    const InBands bands(session(), given);
    const std::size_t before = session().traffic().made;
    stage.run();
    const auto made = static_cast<double>(session().traffic().made - before);
    EXPECT_NEAR(made / static_cast<double>(rows * row_bytes), 1, 0.01) << stage.kernel;
  }
}

/// They write a band's own rows alone; `linear` reads columns beside the frame.
TEST(Memory, BandsOfMethodsTakeWhatTheLaunchTableSays) {
  const Frame frame = tall_frame();
  GatherSettings literal;
  literal.kind = GatherKind::literal;
  literal.passes = 1;
  struct Method {
    const char* kernel;
    int reach_px;  ///< Of the discs of 2 px, with the launch table's.
    std::size_t source_columns;
    std::function<void()> run;
  };
  for (const Method& method :
       {Method{"linear_psf", 2, 48 + 2 * 2, [&] { device().linear(frame); }},
        Method{"gather_literal", 4, 40, [&] { device().gather(frame, literal); }}}) {
    const std::size_t given = band_bytes(method.kernel, frame, 2, 150);
    EXPECT_EQ(given,
              (150 + 2 * size(method.reach_px)) * method.source_columns * 5 * 4 + 150 * 40 * 4 * 4);
    const InBands bands(session(), given);
    const std::size_t before = session().traffic().made;
    method.run();
    // 4 bands of 150 rows; the first and the last have none around them on one side.
    const std::size_t read = (600 + 6 * size(method.reach_px)) * method.source_columns * 5 * 4;
    const auto made = static_cast<double>(session().traffic().made - before);
    EXPECT_NEAR(made / static_cast<double>(read + 600 * 40 * 4 * 4), 1, 0.01) << method.kernel;
  }
}

TEST(Memory, PassesOfTheRdbTakeWhatTheirPlanSays) {
  const Frame frame = tall_frame_with_depth();
  for (const bool wants_nearest : {false, true}) {
    RayPlan plan = plan_rays({9});
    plan.by = RaysBy::scatter;
    plan.wants_nearest = wants_nearest;
    const std::size_t cells = plan.lens.points.size(), given = 40 * 40 * 20 * sizeof(RdbWinner);
    const InBands bands(session(), given);
    std::size_t windows = 0, band_pixels = 0, most_cells = 0;
    int last_y = -1;
    for (const RdbPass& pass :
         plan_rdb_passes(40, {0, 600}, 600, static_cast<int>(cells), rdb_reach(2 * 256), given)) {
      if (pass.y != last_y) windows += 40 * size(pass.window_rows);
      last_y = pass.y;
      band_pixels = std::max(band_pixels, 40 * size(pass.rows));
      most_cells = std::max(most_cells, size(pass.cell_count));
    }
    // CoC, depth, coverage and four channels of windows; cells' winners, and sums: four channels,
    // counts of what was filled and of what was seen, the nearest's key and source.
    const std::size_t a_pixel = most_cells * 8 + 4 * (4 + 1 + 1 + (wants_nearest ? 2 : 0));
    const std::size_t before = session().traffic().made;
    device().rays(frame, plan);
    EXPECT_EQ(session().traffic().made - before,
              windows * 4 * 7 + band_pixels * a_pixel + cells * 2 * 4);
    EXPECT_LE(band_pixels * most_cells * 8, given);
  }
}

TEST(Memory, BandsHaveAsManyRowsAsFit) {
  for (const int reach : {0, 1, 5, 30}) {
    for (const int step : {1, 16}) {
      for (const std::size_t rows : {1u, 40u, 77u, 200u}) {
        constexpr std::size_t row_bytes = 1000;
        const auto bands =
            cut_into_windows({0, 301}, 301, reach, step, {row_bytes}, rows * row_bytes);
        int next = 0;
        for (const BandRows& b : bands) {
          EXPECT_EQ(b.y, next);
          next += b.rows;
          EXPECT_EQ(b.window_y % step, 0);
          EXPECT_LE(b.window_y, std::max(0, b.y - reach));
          EXPECT_GE(b.window_y, std::max(0, b.y - reach) - step + 1);
          EXPECT_EQ(b.window_y + b.window_rows, std::min(301, b.y + b.rows + reach));
          EXPECT_TRUE(b.rows <= step || static_cast<std::size_t>(b.window_rows) <= rows);
        }
        EXPECT_EQ(next, 301);
        // No band fewer than needed: one step more in each would not fit.
        const auto most = static_cast<int>(rows) - 2 * reach - (step - 1);
        const int each = std::max(1, most / step) * step;
        EXPECT_EQ(bands.size(), static_cast<std::size_t>((301 + each - 1) / each));
      }
    }
  }
}

}  // namespace
}  // namespace defray::test::memory_test
