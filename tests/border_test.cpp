// What lies beyond the frame: seen by the confidence, and no source of light that nobody saw.
#include "defocus.h"
#include "method.h"
#include "support.h"

namespace defray::test {
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

  DefocusResult through(Border border) const {
    DefocusSettings settings;
    settings.border = border;
    return defocus({size.width, size.height, coc, depth, channels}, settings, {}, &session());
  }
};

TEST(Border, WhatIsMadeUpBeyondTheFrameIsNotSeen) {
  const Scene scene;
  const DefocusResult clamped = scene.through(Border::clamp),
                      normalised = scene.through(Border::renormalise);
  EXPECT_EQ(clamped.report.border_px, 5);
  EXPECT_EQ(normalised.report.border_px, 0);
  std::size_t less = 0;
  for (std::size_t i = 0; i < clamped.confidence.size(); ++i) {
    ASSERT_LE(clamped.confidence[i], normalised.confidence[i]) << i % 60 << ", " << i / 60;
    less += clamped.confidence[i] < normalised.confidence[i];
  }
  EXPECT_GT(less, 10u);  // the bar's light comes from below the frame
  EXPECT_EQ(clamped.confidence[10 * 60 + 5], 1.0f);
  EXPECT_LT(clamped.confidence[39 * 60 + 30], 1.0f);
}

TEST(Border, ALampOnTheFramesEdgeIsOneLamp) {
  for (const int y : {20, 0}) {
    Scene scene;
    scene.coc.assign(scene.coc.size(), 8 * 256);
    scene.depth.assign(scene.depth.size(), 5.0f);
    scene.channels[0][static_cast<std::size_t>(y) * 60] = 1000;
    // Of a disc on the edge half is inside, of one in the corner a quarter.
    const DefocusResult result = scene.through(Border::clamp);
    double light = 0;
    for (const float v : result.colour[0]) light += v - 0.25;
    EXPECT_EQ(result.report.highlights, 1u);
    EXPECT_NEAR(light / 1000, y == 0 ? 0.28 : 0.53, 0.02);
  }
}

TEST(Border, BlackDoesNotMakeHighlightsOfTheEdge) {
  Scene scene;
  scene.coc.assign(scene.coc.size(), 8 * 256);
  scene.depth.assign(scene.depth.size(), 5.0f);
  EXPECT_EQ(scene.through(Border::black).report.highlights, 0u);
}

TEST(Defocus, AFrameThatDoesNotFitTheDeviceIsRefused) {
  const Scene scene;
  DeviceInfo small = device_under_test();
  small.global_memory_bytes = 60 * 40 * 200;
  Session device(small);
  const PinholeFrame frame{size.width, size.height, scene.coc, scene.depth, scene.channels};
  try {
    defocus(frame, {}, {}, &device);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::device);
    EXPECT_NE(std::string(error.what()).find("60x40 pixels"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace defray::test
