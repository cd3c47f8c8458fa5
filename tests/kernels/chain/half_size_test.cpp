// The chain at half the size: what it must keep of the picture, and what of the lens.
#include "chain/half_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chain/full_size.h"
#include "support.h"

namespace defray::test::half_size_test {
namespace {

constexpr Size size{44, 31};  // an odd side
constexpr std::size_t pixels = 44 * 31;

Frame frame_of(std::vector<std::int32_t> coc, std::vector<Plane> channels, Size s = size) {
  // Farther where the CoC is larger.
  Plane depth;
  for (const std::int32_t c : coc) depth.push_back(1 / (1.5f - static_cast<float>(c) / 25600));
  return {s.width, s.height, std::move(coc), std::move(depth), std::move(channels)};
}

std::vector<std::int32_t> flat(std::int32_t coc) { return std::vector(pixels, coc); }

MethodResult previewed(const Frame& f, bool wants_nearest = false) {
  return run_half_size(f, settings_for(Quality::preview), device(), wants_nearest);
}

TEST(HalfSize, BlocksAreMeansAndHaveASurfacesOwnDepth) {
  // 3x3: blocks at the right and below count their pixels twice.
  const Plane colour{1, 2, 3, 4, 5, 6, 7, 8, 9};
  Frame f = frame_of({40 * 256, 0, 8 * 256, 0, 10 * 256, -8 * 256, 1, 2, 3}, {colour}, {3, 3});
  f.origin_x = 10;
  f.origin_y = 6;
  f.display_width = 21;
  f.display_height = 13;
  const HalfFrame half = at_half_size(f);
  EXPECT_EQ(half.frame.width, 2);
  EXPECT_EQ(half.frame.height, 2);
  EXPECT_EQ(half.frame.origin_x, 5);
  EXPECT_EQ(half.frame.origin_y, 3);
  EXPECT_EQ(half.frame.display_width, 11);
  EXPECT_EQ(half.frame.display_height, 7);
  const auto mean = half.frame.channels[0].host();
  EXPECT_EQ(Plane(mean.begin(), mean.end()), (Plane{3, 4.5f, 7.5f, 9}));
  // Of 40, 0, 0 and 10 px the second 0, which is the third pixel; of 8 and -8 twice the latter.
  EXPECT_EQ(half.source, (std::vector<std::uint32_t>{3, 5, 6, 8}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(half.frame.depth[i], f.depth[half.source[i]]);
    EXPECT_EQ(half.frame.coc_quanta[i], half_size_coc(f.coc_quanta[half.source[i]]));
  }
  EXPECT_FLOAT_EQ(half.detail[0], 0.5f);  // two of four are in focus
  EXPECT_EQ(half.detail[1], 0);
  // Of 8 and -8 px, which count twice, with colours 3 and 6, one is clear.
  EXPECT_EQ(half.clear, (Plane{1, 0.5f, 1, 1}));
  EXPECT_EQ(half.clear_colour[0], (Plane{3, 1.5f, 7.5f, 9}));
}

TEST(HalfSize, ALampIsItsBlocksSurface) {
  for (const float lamp : {0.0f, 2.9f, 3.1f}) {
    const Frame f = frame_of({0, 0, 0, -2560}, {{1, 1, 1, lamp}}, {2, 2});
    EXPECT_EQ(at_half_size(f).source[0], lamp > 3 ? 3u : 0u) << lamp;
  }
}

TEST(HalfSize, TheLensAddsWhatHalvingDoesNotBlur) {
  EXPECT_EQ(half_size_coc(0), 0);
  EXPECT_EQ(half_size_coc(512), 0);
  EXPECT_EQ(half_size_coc(-512), 0);
  for (const int px : {3, 8, 40, -3, -40}) {
    const double variance = std::pow(half_size_coc(px * 256) / 128.0, 2) / 4;  // px^2 of the frame
    EXPECT_NEAR(variance + 1, px * px / 4.0, 0.01 * px * px) << px;
    EXPECT_EQ(half_size_coc(px * 256) < 0, px < 0);
  }
  EXPECT_EQ(half_size_coc(1 << 30), DEFRAY_TAME_QUANTA / 2);
}

TEST(HalfSize, DetailIsWhatADiscLeaves) {
  EXPECT_EQ(detail_left(0), 1);
  EXPECT_EQ(detail_left(448), 0);
  EXPECT_EQ(detail_left(-(1 << 30)), 0);
  for (double radius = 0.25; radius < 2; radius += 0.25) {
    double sum = 0;
    constexpr int steps = 100;
    for (int i = 0; i < steps; ++i) {
      const double per_px = 0.25 + 0.25 * (i + 0.5) / steps;
      const double x = 2 * std::numbers::pi * radius * per_px;
      sum += 2 * std::cyl_bessel_j(1, x) / x / steps;
    }
    EXPECT_NEAR(detail_left(static_cast<std::int32_t>(256 * radius)), sum, 0.04) << radius;
  }
}

TEST(HalfSize, FullSizeIsLinearBetweenBlocks) {
  const Plane ramp{0, 4, 8, 2, 6, 10};
  EXPECT_EQ(at_full_size(ramp, 5, 3),
            (Plane{0, 1, 3, 5, 7, 0.5f, 1.5f, 3.5f, 5.5f, 7.5f, 1.5f, 2.5f, 4.5f, 6.5f, 8.5f}));
  EXPECT_EQ(at_full_size({3}, 1, 1), Plane{3});
}

TEST(HalfSize, WhatIsInFocusStaysAsItIs) {
  const Plane colour = random_plane(size, 4);
  const Plane seen = previewed(frame_of(flat(0), {colour})).colour[0];
  for (std::size_t i = 0; i < seen.size(); ++i)
    EXPECT_NEAR(seen[i], colour[i], 1e-6f * (1 + std::fabs(colour[i]))) << i;
}

TEST(HalfSize, OneColourStaysThatColour) {
  std::vector<std::int32_t> coc;
  for (std::size_t i = 0; i < pixels; ++i) {
    coc.push_back(static_cast<std::int32_t>(i % 44) * 100 - 1500);
  }
  const MethodResult r = previewed(frame_of(coc, {Plane(pixels, 0.7f)}));
  for (const float value : r.colour[0]) EXPECT_FLOAT_EQ(value, 0.7f);
}

/// A near post out of focus over the right half of a checkered wall in focus.
Frame post(std::vector<Plane>* channels = nullptr) {
  std::vector<std::int32_t> coc;
  Plane wall;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool is_post = x >= 22;
      coc.push_back(is_post ? -6 * 256 : 0);
      wall.push_back(is_post ? 0.5f : static_cast<float>((x + y) % 2));
    }
  }
  return frame_of(coc, channels ? *channels : std::vector<Plane>{wall});
}

Plane wall_of(const Frame& f) { return {f.channels[0].begin(), f.channels[0].end()}; }

TEST(HalfSize, SharpEdgesOfWhatIsNearAndBlurredDoNotShow) {
  // A bar of 6 px before a white wall in focus, blurred by 12 px: a faint shadow.
  for (const int left : {20, 21}) {
    std::vector<std::int32_t> coc;
    Plane colour;
    for (int i = 0; i < static_cast<int>(pixels); ++i) {
      const bool is_bar = i % size.width >= left && i % size.width < left + 6;
      coc.push_back(is_bar ? -12 * 256 : 0);
      colour.push_back(is_bar ? 0.0f : 1.0f);
    }
    const Plane seen = previewed(frame_of(coc, {colour})).colour[0];
    for (std::size_t x = 0; x + 1 < size.width; ++x) {
      const std::size_t at = 16 * size.width + x;
      EXPECT_LT(std::fabs(seen[at] - seen[at + 1]), 0.2f) << left << " " << x;
    }
  }
}

TEST(HalfSize, DetailShowsAsFarAsItsSurfaceDoes) {
  const Plane seen = previewed(post()).colour[0];
  const auto contrast = [&](int x) {
    const std::size_t at = 16 * 44 + static_cast<std::size_t>(x);
    return std::abs(seen[at] - seen[at + 1]);
  };
  EXPECT_NEAR(contrast(4), 1, 0.001);
  // The post's blur covers half of what lies at its edge.
  EXPECT_GT(contrast(18), 0.5);
  EXPECT_LT(contrast(18), 0.97);
  EXPECT_LT(contrast(36), 0.02);
}

TEST(HalfSize, AlphaGoesThroughTheLensToo) {
  const Plane wall = wall_of(post());
  for (const float most : {1.0f, 0.8f}) {
    std::vector<Plane> channels(3, wall);
    channels.emplace_back(pixels, most);
    channels[3][16 * 44 + 4] = 0.8f;  // in focus
    for (Plane& c : channels) c[16 * 44 + 4] = std::min(c[16 * 44 + 4], 0.8f);
    Frame f = post(&channels);
    f.has_alpha = true;
    const auto colour = previewed(f).colour;
    ASSERT_EQ(colour.size(), 4u);
    EXPECT_NEAR(colour[3][16 * 44 + 4], 0.8f, 0.01);
    EXPECT_NEAR(colour[3][16 * 44 + 40], most, 1e-5);
    EXPECT_NEAR(colour[0][16 * 44 + 8] - colour[0][16 * 44 + 9],
                wall[16 * 44 + 8] - wall[16 * 44 + 9], 0.05);
  }
  std::vector<Plane> opaque{wall, wall, wall, Plane(pixels, 1.0f)};
  Frame f = post(&opaque);
  f.has_alpha = true;
  EXPECT_EQ(previewed(f).colour[3], opaque[3]);
  // An alpha that is 1 makes room for what is visible: the same colours as without it.
  EXPECT_EQ(previewed(f).colour[0], previewed(post()).colour[0]);
  // Where what is visible stands out it is light as well, not alpha.
  std::vector<Plane> lit{wall, wall, wall};
  for (Plane& c : lit) c[16 * 44 + 40] = 500;
  const Plane without = previewed(post(&lit)).colour[2];
  lit.emplace_back(pixels, 1.0f);
  Frame lamp = post(&lit);
  lamp.has_alpha = true;
  EXPECT_EQ(previewed(lamp).colour[2], without);
}

TEST(HalfSize, FourChannelsMayAllBeLight) {
  std::vector<Plane> four(4, wall_of(post()));
  const auto colour = previewed(post(&four)).colour;
  ASSERT_EQ(colour.size(), 4u);
  for (std::size_t c = 1; c < 4; ++c) EXPECT_EQ(colour[c], colour[0]);
}

TEST(HalfSize, DataIsOfThePixelsThatShow) {
  const MethodResult r = previewed(post(), true);
  ASSERT_EQ(r.nearest.size(), pixels);
  ASSERT_EQ(r.confidence.size(), pixels);
  EXPECT_EQ(r.nearest[16 * 44 + 3], 16u * 44 + 3);  // its own
  EXPECT_GE(r.nearest[16 * 44 + 20] % 44, 22u);     // the post, in front of it
  EXPECT_EQ(r.report->stages.front().stage, "half size");
  EXPECT_EQ(r.report->stages.back().stage, "full size");
}

TEST(HalfSize, FramesOfOnePixelAndOneRow) {
  for (const Size s : {Size{1, 1}, Size{1, 7}, Size{6, 1}}) {
    const auto count = static_cast<std::size_t>(s.width * s.height);
    const Frame f = frame_of(std::vector<std::int32_t>(count, 2000), {Plane(count, 0.3f)}, s);
    const MethodResult r = previewed(f);
    for (const float value : r.colour[0]) EXPECT_FLOAT_EQ(value, 0.3f);
  }
}

TEST(HalfSize, NothingIsDarkerThanBlackAndNoNumbersStay) {
  std::vector<Plane> channels{wall_of(post())};
  channels[0][100] = std::nanf("");
  channels[0][300] = 50;
  const Frame f = post(&channels);
  const Plane seen = previewed(f).colour[0];
  int numbers = 0;
  for (const float value : seen) {
    numbers += std::isfinite(value);
    EXPECT_FALSE(value < 0);
  }
  EXPECT_GT(numbers, static_cast<int>(pixels) - 40);
}

}  // namespace
}  // namespace defray::test::half_size_test
