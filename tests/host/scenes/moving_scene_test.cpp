// The built-in scenes that move, and the ones made for one thing: lights, cut-outs.
#include <algorithm>
#include <cmath>

#include "measure/flicker.h"
#include "scenes/builtin/builtin.h"
#include "scenes/geometry/flat_shapes.h"
#include "scenes/tracing/render.h"
#include "support.h"

namespace defray::test::moving_scene_test {
namespace {

/// Columns of the picture's first row that the fence covers.
std::vector<int> fence_columns(int frame, int width) {
  const Plane depth = render_pinhole(make_scene("drift", width, 3, frame)).depth;
  std::vector<int> columns;
  for (int x = 0; x < width; ++x) {
    if (depth[static_cast<std::size_t>(x)] == 1) columns.push_back(x);
  }
  return columns;
}

TEST(Drift, MovesByAFractionOfAPixelSidewaysAlone) {
  EXPECT_EQ(scene_info("drift").frames, 24);
  // 100 times as fine: 3.37 px a frame of a picture 640 wide are 84.25 of one 16000 wide.
  const auto first = fence_columns(1, 16000), second = fence_columns(2, 16000);
  const int step = second.back() - first.back();
  EXPECT_TRUE(step == 84 || step == 85) << step;
  const Plane top = render_pinhole(make_scene("drift", 640, 480, 24)).depth;
  for (std::size_t x = 0; x < 640; ++x) EXPECT_EQ(top[x] == 1, top[100 * 640 + x] == 1);
  expect_error(ErrorKind::usage, {"'drift' has no frame 25", "1 to 24"},
               [] { make_scene("drift", 8, 8, 25); });
  expect_error(ErrorKind::usage, {"'fence' has no frame 2", "1 to 1"},
               [] { make_scene("fence", 8, 8, 2); });
}

TEST(Drift, WhatDoesNotMoveStaysAsItWas) {
  const auto wall = [](int frame) { return render_pinhole(make_scene("drift", 160, 120, frame)); };
  const ScenePicture a = wall(1), b = wall(9);
  int still = 0;
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    if (a.depth[i] == 1 || b.depth[i] == 1) continue;
    ++still;
    EXPECT_EQ(a.colour[0][i], b.colour[0][i]);
    EXPECT_EQ(a.depth[i], b.depth[i]);
  }
  EXPECT_GT(still, 160 * 120 / 3);
  EXPECT_GT(flicker(a.colour, b.colour, a.colour, b.colour).truth_rms, 0.02);
}

TEST(Drift, TheFenceDissolvesBeforeTheFace) {
  // The fence's CoC is wider than its bars: nowhere does one hide all that lies behind.
  const Scene scene = make_scene("drift", 640, 480);
  const Lens lens = lens_of(scene, find_setting(scene, "face"));
  const double coc_px = background_coc_px(lens, 640) * std::fabs(1 - lens.focus_distance_units / 1);
  const auto columns = fence_columns(1, 640);
  int widest = 0, run = 0;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    run = columns[i] == columns[i - 1] + 1 ? run + 1 : 1;
    widest = std::max(widest, run);
  }
  EXPECT_GT(widest, 8);
  EXPECT_GT(2 * coc_px, widest * 1.3);
}

/// The lamps of a frame, in their order.
std::vector<const Emitter*> lamps(const Scene& scene) {
  std::vector<const Emitter*> all;
  for (const auto& primitive : scene.primitives) {
    if (const auto* lamp = dynamic_cast<const Emitter*>(primitive.get())) all.push_back(lamp);
  }
  return all;
}

TEST(Garden, LampsPassBehindThePosts) {
  EXPECT_EQ(scene_info("garden").frames, 24);
  const Scene first = make_scene("garden", 640, 400), second = make_scene("garden", 640, 400, 2);
  const Lens lens = lens_of(first, find_setting(first, "grass"));
  for (std::size_t i = 0; i < lamps(first).size(); ++i) {
    const Vec3 a = lamps(first)[i]->centre(), b = lamps(second)[i]->centre();
    const double px = (b.x - a.x) * pixel_focal_length(first) / a.z;
    EXPECT_GE(px, 2) << i;
    EXPECT_LE(px, 4) << i;
    EXPECT_EQ(a.y, b.y) << i;
    EXPECT_GT(background_coc_px(lens, 640) * (1 - lens.focus_distance_units / a.z), 3) << i;
  }
  int passing = 0;
  for (std::size_t i = 0; i < lamps(first).size(); ++i) {
    int hidden = 0;
    for (int frame = 1; frame <= 24; ++frame) {
      const Scene scene = make_scene("garden", 640, 8, frame);
      const Vec3 at = lamps(scene)[i]->centre();
      const double column = 320 + at.x / at.z * pixel_focal_length(scene);
      if (column < 0 || column >= 640) continue;
      hidden += render_pinhole(scene).depth[static_cast<std::size_t>(column)] == 1.2f;
    }
    passing += hidden > 0 && hidden < 24;
  }
  EXPECT_GE(passing, 4);
}

TEST(Garden, GrassSwaysAndIsWhereItWasAfterAllFrames) {
  // What is not a lamp has gone round after 24 frames: the last is a step before the first.
  const auto depth = [](int frame) {
    return render_pinhole(make_scene("garden", 640, 400, frame)).depth;
  };
  const Plane first = depth(1);
  const auto changed = [&](const Plane& other) {
    int count = 0;
    for (std::size_t i = 0; i < first.size(); ++i) count += first[i] != other[i];
    return count;
  };
  const int next = changed(depth(2)), last = changed(depth(24)), half = changed(depth(13));
  EXPECT_GT(next, 640);
  EXPECT_LT(std::abs(next - last), next / 2);
  EXPECT_GT(half, 2 * next);
  const Plane second = depth(2);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i] == 1.2f, second[i] == 1.2f) << "a post does not move";
  }
}

}  // namespace
}  // namespace defray::test::moving_scene_test
