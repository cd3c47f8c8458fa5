// Nearest hits: kernel rdb_nearest, and whose data each pixel gets after the stages.
#include <cmath>
#include <limits>
#include <set>

#include "chain/chain.h"
#include "faults/fault.h"
#include "methods/method.h"
#include "rdb/rdb_plan.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::rdb_nearest_test {
namespace {

using Words = std::vector<std::uint32_t>;

struct Scene {
  Size size;
  std::vector<std::int32_t> coc;
  Plane depth;
  std::vector<Plane> channels;
  std::size_t count() const { return depth.size(); }
  Frame frame() const { return {size.width, size.height, coc, depth, channels}; }
};

Scene random_scene(Size size, std::uint32_t seed) {
  return {size,
          random_coc(size, 4, seed),
          random_depth(size, seed + 1),
          {random_plane(size, seed + 2)}};
}

/// A near bar, out of focus, in front of a wall in focus, from column x0 up to x1; edges sharp.
Scene bar(Size size, int x0, int x1) {
  Scene s{size, {}, {}, {}};
  s.channels.resize(3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool is_bar = x >= x0 && x < x1;
      s.coc.push_back(is_bar ? -4 * 256 : 0);
      s.depth.push_back(is_bar ? 1.0f : 5.0f);
      s.channels[0].push_back(is_bar ? 0.9f : 0.1f);
      s.channels[1].push_back(is_bar ? 0.2f : 0.8f);
      s.channels[2].push_back(0.5f);
    }
  }
  return s;
}

std::vector<std::uint32_t> hits(const Scene& s, int cells_per_side, Backend& backend) {
  RayPlan plan = plan_rays({cells_per_side});
  plan.wants_nearest = true;
  return backend.rays(s.frame(), plan).nearest;
}

MethodResult through(const Scene& s, const ChainSettings& settings, Backend& backend) {
  return run_chain(s.frame(), settings, backend, true);
}

TEST(Nearest, KernelEqualsItsTwinWhateverTheBands) {
  for (const Size size : awkward_sizes()) {
    if (is_slow_device() && size.width > 100) continue;
    const std::size_t rows = size.height > 50 ? 40 : 1;  // a row alone takes many passes there
    const Scene s = random_scene(size, 7);
    const int cells = is_slow_device() ? 3 : 7;
    const auto expected = hits(s, cells, twins());
    EXPECT_EQ(hits(s, cells, device()), expected);
    const std::size_t bytes = rows * static_cast<std::size_t>(size.width) * rdb_bytes_a_pixel(1);
    const InBands in_bands(session(), bytes), too(session_without_int64(), bytes);
    EXPECT_EQ(hits(s, cells, device()), expected) << "few rows and cells a pass";
    DeviceBackend two_passes(session_without_int64());
    EXPECT_EQ(hits(s, cells, two_passes), expected);
  }
}

TEST(Nearest, IsTheSmallestRadiusOfAllCellsWinners) {
  const Scene s = random_scene({23, 17}, 3);
  const RayPlan plan = plan_rays({5});
  std::vector<std::set<std::pair<std::int32_t, std::int64_t>>> met(s.count());
  for (std::size_t cell = 0; cell < plan.lens.points.size(); ++cell) {
    const auto winner = reference::rdb_scatter(s.frame(), plan, cell);
    for (std::size_t i = 0; i < winner.size(); ++i) {
      if (winner[i] >= 0) met[i].emplace(s.coc[static_cast<std::size_t>(winner[i])], winner[i]);
    }
  }
  const auto nearest = hits(s, 5, device());
  int moved = 0;
  for (std::size_t i = 0; i < s.count(); ++i) {
    const std::uint32_t expected =
        met[i].empty() ? DEFRAY_EMPTY : static_cast<std::uint32_t>(met[i].begin()->second);
    EXPECT_EQ(nearest[i], expected) << i;
    moved += nearest[i] != i;
  }
  EXPECT_GT(moved, 100);
}

TEST(Nearest, OnlyOnDemand) {
  const Scene s = random_scene({9, 5}, 1);
  EXPECT_TRUE(run_chain(s.frame(), {}, device()).nearest.empty());
  MethodSettings literal;
  EXPECT_TRUE(apply_method(s.frame(), literal, device()).nearest.empty());
  for (Backend* on : device_and_twins()) {
    const MethodResult details = apply_method(s.frame(), literal, *on, true);
    for (const std::uint32_t i : details.nearest) EXPECT_LT(i, s.count());
    EXPECT_EQ(details.nearest.size(), s.count());
  }
}

TEST(NearestPicture, ABlurredBarsDataReachAsFarAsItsLight) {
  const Scene s = bar({48, 24}, 20, 30);
  for (Backend* on : device_and_twins()) {
    const MethodResult r = through(s, {}, *on);
    for (std::size_t i = 0; i < s.count(); ++i) {
      const int x = static_cast<int>(i) % 48;
      const float depth = s.depth[r.nearest[i]];
      if (x >= 17 && x < 33) {
        EXPECT_EQ(depth, 1.0f) << x;
      }
      if (x < 15 || x >= 35) {
        EXPECT_EQ(depth, 5.0f) << x;
      }
      if (x < 15 || x >= 35) {
        EXPECT_EQ(r.nearest[i], i) << "in focus, pixels keep their own";
      }
    }
  }
}

// The wall is made up behind the bar: its fragments there stand in the bar's pixels, whose data are
// the bar's.
TEST(NearestPicture, MadeUpSurfacesHaveNoData) {
  Scene s = bar({48, 24}, 23, 26);
  for (std::size_t i = 0; i < s.count(); ++i) s.coc[i] = s.depth[i] == 1.0f ? 0 : 6 * 256;
  const MethodResult r = through(s, {}, device());
  EXPECT_GT(r.report->behind, 0u);
  for (std::size_t i = 0; i < s.count(); ++i) {
    const bool is_bar = s.depth[i] == 1.0f;
    EXPECT_EQ(s.depth[r.nearest[i]] == 1.0f, is_bar) << i % 48;
  }
}

// Edge pixels half covered, whose depth saw the wall: the bar's share has the bar's data.
TEST(NearestPicture, WhatSplitTakesFromBesideHasTheDataFromThere) {
  Scene s = bar({48, 24}, 20, 30);
  for (std::size_t i = 0; i < s.count(); ++i) {
    const int x = static_cast<int>(i) % 48;
    if (x != 19 && x != 30) continue;
    for (std::size_t c = 0; c < 2; ++c) s.channels[c][i] = 0.5f;
  }
  const MethodResult r = through(s, {}, device());
  EXPECT_GT(r.report->split, 0u);
  for (std::size_t i = 0; i < s.count(); ++i) {
    const int x = static_cast<int>(i) % 48;
    // The share in column 19 reaches columns 16 to 22, before the bar's own.
    if (x >= 17 && x < 33) {
      EXPECT_EQ(s.depth[r.nearest[i]], 1.0f) << x;
    }
  }
}

TEST(NearestPicture, BordersGiveTheEdgesData) {
  Scene s = random_scene({20, 16}, 5);
  s.coc.assign(s.count(), 5 * 256);
  s.depth.assign(s.count(), 2.0f);
  for (const Border border : {Border::clamp, Border::black, Border::renormalise}) {
    ChainSettings settings;
    settings.border = border;
    const MethodResult r = through(s, settings, device());
    for (std::size_t i = 0; i < s.count(); ++i) {
      ASSERT_LT(r.nearest[i], s.count());
      const int dx = static_cast<int>(r.nearest[i] % 20) - static_cast<int>(i % 20);
      const int dy = static_cast<int>(r.nearest[i] / 20) - static_cast<int>(i / 20);
      EXPECT_LE(std::max(std::abs(dx), std::abs(dy)), 6);
    }
  }
}

const FaultRows faults{
    {"rdb_nearest", "the farthest", {"w.y < best.y ||", "w.y > best.y ||"}},
    {"rdb_nearest", "ties to the larger index", {"w.x < best.x);", "w.x > best.x);"}},
    {"rdb_nearest",
     "made-up fragments count",
     {"(p.has_data_of && data_of[w.x] == DEFRAY_EMPTY)", "false"}},
    {"rdb_nearest",
     "minimum begun anew with each pass",
     {"uint2 best = p.is_first_pass ? (uint2)(DEFRAY_EMPTY) :",
      "uint2 best = 1 ? (uint2)(DEFRAY_EMPTY) :"}},
    {"rdb_nearest",
     "stale minimum of the band before",
     {"uint2 best = p.is_first_pass ? (uint2)(DEFRAY_EMPTY) :",
      "uint2 best = p.is_first_pass && p.band_y == 0 ? (uint2)(DEFRAY_EMPTY) :"}},
    {"rdb_nearest",
     "rim's row in the band",
     {"passes_rim(lens[p.first_cell + k], rim_x[x], rim_y[p.band_y + row])) {\n      "
      "continue;\n    "
      "}\n    best",
      "passes_rim(lens[p.first_cell + k], rim_x[x], rim_y[row])) {\n      continue;\n    }\n  "
      "  "
      "best"}},
};

}  // namespace
}  // namespace defray::test::rdb_nearest_test
