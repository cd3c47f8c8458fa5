// What lies beyond the frame: goes on like the edge, seen by the confidence, and no source of light
// that nobody saw.
#include "chain/steps/border.h"

#include <cmath>
#include <limits>
#include <tuple>

#include "chain/chain.h"
#include "chain/steps/layers.h"
#include "extended_frame.h"
#include "methods/method.h"
#include "support.h"

namespace defray::test::border_test {
namespace {

constexpr Size size{60, 40};

/// A grey wall in focus, and a bar in front of it across the frame's lower border.
struct Scene {
  std::vector<std::int32_t> coc = std::vector<std::int32_t>(60 * 40, 0);
  Plane depth = Plane(60 * 40, 5.0f);
  std::vector<Plane> channels = {Plane(60 * 40, 0.25f)};

  Scene() {
    for (std::size_t y = 24; y < 40; ++y) {
      for (std::size_t x = 25; x < 35; ++x) coc[y * 60 + x] = -4 * 256, depth[y * 60 + x] = 1;
    }
  }

  MethodResult through(Border border) const {
    ChainSettings settings;
    settings.border = border;
    return run_chain({size.width, size.height, coc, depth, channels}, settings, device());
  }
};

TEST(BorderPicture, WhatIsMadeUpBeyondTheFrameIsNotSeen) {
  const Scene scene;
  const MethodResult clamped = scene.through(Border::clamp),
                     normalised = scene.through(Border::renormalise);
  EXPECT_EQ(clamped.report->border_px, 5);
  EXPECT_EQ(normalised.report->border_px, 0);
  std::size_t less = 0;
  for (std::size_t i = 0; i < clamped.confidence.size(); ++i) {
    ASSERT_LE(clamped.confidence[i], normalised.confidence[i]) << i % 60 << ", " << i / 60;
    less += clamped.confidence[i] < normalised.confidence[i];
  }
  EXPECT_GT(less, 10u);  // the bar's light comes from below the frame
  EXPECT_EQ(clamped.confidence[10 * 60 + 5], 1.0f);
  EXPECT_LT(clamped.confidence[39 * 60 + 30], 1.0f);
}

TEST(BorderPicture, FartherOutTheEdgeFadesToTheMeanOfItsSurface) {
  Scene scene;
  scene.coc.assign(scene.coc.size(), 6 * 256);
  for (std::size_t i = 0; i < scene.coc.size(); ++i) {
    const std::size_t x = i % 60;
    scene.channels[0][i] = static_cast<float>(x);
    if (x >= 3 && x < 10) scene.coc[i] = 0;  // another surface
    if (i / 60 == 20) scene.channels[0][i] = std::numeric_limits<float>::quiet_NaN();
  }
  ChainReport report;
  Frame f =
      extended({60, 40, scene.coc, scene.depth, scene.channels}, Border::clamp, false, report);
  continue_colours(f);
  const int m = report.border_px;
  ASSERT_EQ(m, 7);
  const auto at = [&](int x, int y) { return f.channels[0][f.index(x + m, y + m, 0)]; };
  const float left[7] = {0, 0.5, 1, 1, 1, 1, 1}, right[7] = {59, 58.5, 58, 57.5, 57, 56.5, 56};
  for (int d = 0; d < 7; ++d) {
    EXPECT_EQ(at(-1 - d, 5), left[d]) << d;
    EXPECT_EQ(at(60 + d, 5), right[d]) << d;
    EXPECT_EQ(at(30, -1 - d), 30) << d;  // one colour stays that colour
    EXPECT_EQ(at(-1 - d, -1 - d), left[d]) << d;
    EXPECT_TRUE(std::isnan(at(-1 - d, 20))) << d;
  }
}

TEST(BorderPicture, ReachesAsFarAsDiscsDoUpToHalfTheFrame) {
  for (const auto& [coc, px, is_cut] : {std::tuple{3 * 256, 4, false},
                                        {18 * 256, 19, false},
                                        {19 * 256, 20, false},
                                        {25 * 256, 20, true}}) {
    Scene scene;
    scene.coc.assign(scene.coc.size(), coc);
    const MethodResult result = scene.through(Border::clamp);
    EXPECT_EQ(result.report->border_px, px) << coc;
    EXPECT_EQ(result.report->border_is_cut, is_cut) << coc;
  }
}

TEST(BorderPicture, ALampOnTheFramesEdgeIsOneLamp) {
  for (const int y : {20, 0}) {
    Scene scene;
    scene.coc.assign(scene.coc.size(), 8 * 256);
    scene.depth.assign(scene.depth.size(), 5.0f);
    scene.channels[0][static_cast<std::size_t>(y) * 60] = 1000;
    // Of a disc on the edge half is inside, of one in the corner a quarter.
    const MethodResult result = scene.through(Border::clamp);
    double light = 0;
    for (const float v : result.colour[0]) light += v - 0.25;
    EXPECT_EQ(result.report->highlights, 1u);
    EXPECT_NEAR(light / 1000, y == 0 ? 0.28 : 0.53, 0.02);
  }
}

TEST(BorderPicture, BlackDoesNotMakeHighlightsOfTheEdge) {
  Scene scene;
  scene.coc.assign(scene.coc.size(), 8 * 256);
  scene.depth.assign(scene.depth.size(), 5.0f);
  EXPECT_EQ(scene.through(Border::black).report->highlights, 0u);
}

TEST(Chain, AFrameThatDoesNotFitTheHostIsRefused) {
  const Scene scene;
  DeviceInfo small = device_under_test();
  small.global_memory_bytes = 60 * 40 * 100;
  small.shares_host_memory = true;  // only then it is the host's
  Session session(small);
  DeviceBackend device(session);
  const Frame frame{size.width, size.height, scene.coc, scene.depth, scene.channels};
  try {
    run_chain(frame, {}, device);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::device);
    EXPECT_NE(std::string(error.what()).find("60x40 pixels"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace defray::test::border_test
