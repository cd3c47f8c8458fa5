// What blocks hold of pictures whose means are known.
#include "prediction/blocks.h"

#include <cmath>

#include "base/srgb.h"
#include "prediction/strip.h"
#include "support.h"

namespace defray::test::blocks_test {
namespace {

/// A frame of one channel, and a result like it.
struct Scene {
  Scene(int width, int height, float value)
      : frame{width, height, Quanta(std::vector<std::int32_t>(size(width) * size(height)))},
        colour{Plane(size(width) * size(height), value)},
        result(colour),
        confidence(colour[0].size(), 1.0f) {}

  PixelBlocks blocks() {
    frame.channels = Planes(colour);
    frame.coc_quanta = coc.empty() ? Quanta(std::vector<std::int32_t>(frame.pixels())) : coc;
    return blocks_of(frame, result, confidence, {0, block_rows(frame)});
  }

  /// A radius in px at each pixel.
  template <typename RadiusAt>
  void set_coc(const RadiusAt& radius_at) {
    std::vector<std::int32_t> quanta;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        quanta.push_back(static_cast<std::int32_t>(std::lround(radius_at(x, y) * 256)));
      }
    }
    coc = quanta;
  }

  Frame frame;
  std::vector<Plane> colour, result;
  Plane confidence;
  std::vector<std::int32_t> coc = {};
};

TEST(Shown, IsTheDisplaysToAThousandth) {
  for (const float linear : {1e-6f, 0.001f, 0.0031f, 0.01f, 0.1803f, 0.5f, 0.75f, 0.99f}) {
    EXPECT_NEAR(shown(linear), shown_value(linear), 1e-3 * shown_value(linear)) << linear;
  }
  EXPECT_EQ(shown(0), 0.0f);
  EXPECT_EQ(shown(-3), 0.0f);
  EXPECT_EQ(shown(1), 1.0f);
  EXPECT_EQ(shown(1e9f), 1.0f);
  EXPECT_EQ(shown(HUGE_VALF), 1.0f);
  EXPECT_EQ(shown(NAN), 0.0f);
}

TEST(Blocks, OfAnEvenPictureAreEven) {
  Scene scene(9, 6, 0.2f);
  const PixelBlocks blocks = scene.blocks();
  ASSERT_EQ(blocks.across, 3);
  ASSERT_EQ(blocks.down, 2);
  const float value = shown(0.2f);
  for (const PixelBlock& b : blocks.blocks) {
    EXPECT_NEAR(b.pinhole.mean[0], value, 1e-6);
    EXPECT_NEAR(b.result.square, value * value, 1e-6);
    for (const float none : {b.rim, b.sharp_grain, b.slight_gradient, b.edge, b.unseen, b.reach,
                             b.edge_gradient, b.lost_grain}) {
      EXPECT_NEAR(none, 0, 1e-12);
    }
  }
}

TEST(Blocks, HaveTheGrainAndGradientOfTheirPixels) {
  // One white pixel in the middle of a black block: 9 pixels have grain, its neighbours a gradient.
  Scene scene(12, 12, 0);
  scene.colour[0][5 * 12 + 5] = scene.result[0][5 * 12 + 5] = 1;
  scene.set_coc([](int, int) { return 0.2; });
  const PixelBlock sharp = scene.blocks().at(1, 1);
  const double centre = 8 / 9.0, beside = 1 / 9.0;
  EXPECT_NEAR(sharp.sharp_grain, (centre * centre + 8 * beside * beside) / 16, 1e-6);
  EXPECT_EQ(sharp.slight_gradient, 0.0f);
  EXPECT_NEAR(sharp.lost_grain, 0.2 * sharp.sharp_grain, 1e-3 * sharp.sharp_grain);
  scene.set_coc([](int, int) { return -0.5; });
  const PixelBlock slight = scene.blocks().at(1, 1);
  EXPECT_EQ(slight.slight_grain, sharp.sharp_grain);
  EXPECT_EQ(slight.sharp_grain, 0.0f);
  EXPECT_NEAR(slight.slight_gradient, 4 * 0.25 / 16, 1e-6);
  scene.set_coc([](int, int) { return 2.0; });
  EXPECT_EQ(scene.blocks().at(1, 1).slight_gradient, slight.slight_gradient);
  EXPECT_EQ(scene.blocks().at(1, 1).slight_grain, 0.0f);
  EXPECT_EQ(scene.blocks().at(1, 1).soft_grain, 0.0f);
  scene.set_coc([](int, int) { return -4.0; });
  const PixelBlock soft = scene.blocks().at(1, 1);
  EXPECT_EQ(soft.soft_grain, sharp.sharp_grain);
  EXPECT_EQ(soft.slight_gradient, 0.0f);
  EXPECT_EQ(soft.lost_grain, sharp.sharp_grain);
  EXPECT_EQ(soft.reach, 4.0f);
  EXPECT_EQ(soft.least_coc, -4.0f);
  scene.set_coc([](int, int) { return 7.0; });
  EXPECT_EQ(scene.blocks().at(1, 1).soft_grain, 0.0f);
}

TEST(Blocks, PixelsAroundOneCountWhereverItLiesInItsBlock) {
  for (int place = 0; place < 16; ++place) {
    const int px = 4 + place % 4, py = 4 + place / 4;
    Scene scene(12, 12, 0);
    scene.colour[0][size(py * 12 + px)] = 1;
    scene.set_coc([&](int x, int y) { return x == px && y == py ? 0.0 : 0.25; });
    const PixelBlocks blocks = scene.blocks();
    for (int block = 0; block < 9; ++block) {
      double grain = 0, beside = 0, around = 0;
      for (int i = 0; i < 16; ++i) {
        const int dx = std::abs(block % 3 * 4 + i % 4 - px),
                  dy = std::abs(block / 3 * 4 + i / 4 - py);
        if (dx > 1 || dy > 1) continue;
        ++around;
        grain += dx + dy == 0 ? 64 / 81.0 : 1 / 81.0;
        beside += dx + dy == 1;
      }
      const PixelBlock& at = blocks.at(block % 3, block / 3);
      EXPECT_NEAR(at.sharp_grain, grain / 16, 1e-6) << place << " " << block;
      EXPECT_NEAR(at.edge, 0.25 * around / 16, 1e-6) << place << " " << block;
      EXPECT_NEAR(at.edge_gradient, 0.25 * 0.25 * beside / 16, 1e-6) << place << " " << block;
    }
  }
}

TEST(Blocks, RimsAreWhatLiesBesideMoreThanWhite) {
  Scene scene(12, 12, 0);
  scene.result[0][5 * 12 + 5] = 2;
  scene.confidence.assign(144, 0.75f);
  const PixelBlock bright = scene.blocks().at(1, 1);
  EXPECT_NEAR(bright.rim, 4 * 0.25 / 16, 1e-6);
  EXPECT_EQ(bright.bright_rim, 0.0f);
  EXPECT_NEAR(bright.unseen_rim, bright.rim / 4, 1e-6);
  EXPECT_NEAR(bright.unseen, 0.25, 1e-6);
  EXPECT_NEAR(bright.unseen_square, 0.0625, 1e-6);
  scene.result[0][5 * 12 + 5] = 5;
  EXPECT_EQ(scene.blocks().at(1, 1).bright_rim, bright.rim);
  scene.result[0][5 * 12 + 5] = 1;
  EXPECT_EQ(scene.blocks().at(1, 1).rim, 0.0f);
}

TEST(Blocks, EdgesAreWhereTheRadiusChanges) {
  Scene scene(16, 8, 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 6; x < 16; ++x) scene.colour[0][size(y * 16 + x)] = 1;
  }
  scene.set_coc([](int x, int) { return x < 6 ? 0.0 : 3.0; });
  const PixelBlock at = scene.blocks().at(1, 0);  // columns 4 to 7; 5 and 6 lie on the edge
  EXPECT_NEAR(at.edge, 0.5, 1e-6);
  EXPECT_NEAR(at.edge_gradient, 0.25 * 0.5, 1e-6);
  EXPECT_EQ(at.mean_coc, 1.5f);
  EXPECT_EQ(at.largest_coc, 3.0f);
  EXPECT_EQ(scene.blocks().at(0, 0).edge, 0.0f);
  scene.set_coc([](int x, int) { return x < 6 ? 0.0 : 0.25; });
  EXPECT_NEAR(scene.blocks().at(1, 0).edge, 0.125, 1e-6);
}

TEST(Blocks, AlphaIsNoLight) {
  Scene scene(8, 8, 0.5f);
  for (int c = 0; c < 3; ++c) scene.colour.emplace_back(64, 0.5f);
  scene.colour[3][9] = 0;
  scene.result = scene.colour;
  scene.frame.has_alpha = true;
  EXPECT_NEAR(scene.blocks().at(0, 0).sharp_grain, 0, 1e-12);
  scene.frame.has_alpha = false;  // a fourth channel is more than displays have
  EXPECT_NEAR(scene.blocks().at(0, 0).sharp_grain, 0, 1e-12);
  scene.colour[2][9] = 0;
  EXPECT_GT(scene.blocks().at(0, 0).sharp_grain, 0.001f);
}

TEST(Blocks, RaggedOnesAreMeansOfWhatTheyHave) {
  Scene scene(5, 5, 0);
  scene.colour[0][24] = 1;
  const PixelBlocks blocks = scene.blocks();
  EXPECT_EQ(blocks.at(1, 1).pinhole.mean[0], 1.0f);
  EXPECT_EQ(blocks.at(0, 1).pinhole.mean[0], 0.0f);
  Scene one(1, 1, 0.5f);
  EXPECT_EQ(one.blocks().blocks.size(), 1u);
}

}  // namespace
}  // namespace defray::test::blocks_test
