// Which blocks' looks count, and how far away.
#include "prediction/signs.h"

#include <cmath>

#include "prediction/error_model.h"
#include "support.h"

namespace defray::test::signs_test {
namespace {

/// Black blocks in focus.
PixelBlocks dark(int across, int down) {
  return {across, down, std::vector<PixelBlock>(size(across) * size(down))};
}

PixelBlock& at(PixelBlocks& blocks, int x, int y) {
  return blocks.blocks[size(y) * size(blocks.across) + size(x)];
}

ShownMoments grey(float value) { return {{value, value, value}, value * value}; }

SignValues signs_at(const PixelBlocks& blocks, int x, int y) {
  const std::vector<SignValues> of_row = signs_of(blocks, 3, {y, y + 1});
  EXPECT_EQ(of_row.size(), size(blocks.across));
  return of_row[size(x)];
}

std::size_t index_of(const std::string& name) {
  const std::vector<std::string> names = sign_names();
  const auto found = std::find(names.begin(), names.end(), name);
  EXPECT_NE(found, names.end()) << name;
  return static_cast<std::size_t>(found - names.begin());
}

TEST(Signs, ContrastCountsAsFarAsBlurReaches) {
  const std::size_t sampling = index_of("contrast in reach / lens points");
  PixelBlocks blocks = dark(65, 65);
  at(blocks, 32 + 16, 32).pinhole = grey(1);
  EXPECT_EQ(signs_at(blocks, 32, 32)[sampling], 0.0f);
  at(blocks, 32, 32).reach = 20;  // 9x9 or 17x17 blocks are looked at
  EXPECT_EQ(signs_at(blocks, 32, 32)[sampling], 0.0f);
  at(blocks, 32, 32).reach = 60;
  const float far = signs_at(blocks, 32, 32)[sampling];
  EXPECT_GT(far, 0.0f);
  EXPECT_NEAR(far, 1 / 25.0 - 1 / 625.0, 1e-6);  // of 25 blocks one is white
  at(blocks, 32, 32).reach = 2;
  at(blocks, 31, 32).pinhole = grey(1);
  EXPECT_NEAR(signs_at(blocks, 32, 32)[sampling], 0.5 * (1 / 9.0 - 1 / 81.0), 1e-6);
}

TEST(Signs, ReachIsThatOfWhatIsNear) {
  const std::size_t sampling = index_of("contrast in reach / lens points");
  PixelBlocks blocks = dark(65, 33);
  for (int x = 32; x < 65; ++x) at(blocks, x, 16).pinhole = grey(1);
  const auto reaching = [&](int distance, float radius_px) {
    PixelBlocks near_blur = blocks;
    at(near_blur, 31 - distance, 16).reach = radius_px;
    return signs_at(near_blur, 31, 16)[sampling] > 0;
  };
  EXPECT_TRUE(reaching(1, 8));
  EXPECT_TRUE(reaching(0, 1));
  EXPECT_FALSE(reaching(20, 8));
  EXPECT_TRUE(reaching(20, 100));
}

TEST(Signs, BlurReachesFromEverySide) {
  const std::size_t sampling = index_of("contrast in reach / lens points");
  PixelBlocks even = dark(17, 17);
  for (int x = 0; x < 17; x += 2) {
    for (int y = 0; y < 17; ++y) at(even, x, y).pinhole = grey(1);
  }
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      PixelBlocks blocks = even;
      at(blocks, 8 + i, 8 + j).reach = 3;
      EXPECT_GT(signs_at(blocks, 8, 8)[sampling], 0.0f) << i << " " << j;
      EXPECT_EQ(signs_at(blocks, 8 - 8 * (i < 0 ? -1 : 1), 8)[sampling], 0.0f) << i << " " << j;
    }
  }
}

TEST(Signs, HiddenColoursAreLikeThoseAtTheBack) {
  const std::size_t hidden = index_of("unseen^2 contrast behind");
  PixelBlocks blocks = dark(9, 9);
  PixelBlock& middle = at(blocks, 4, 4);
  middle.unseen = 0.5f;
  middle.unseen_square = 0.25f;
  // White things in front of an even ground: what is behind is known.
  for (int x = 3; x < 6; ++x) {
    at(blocks, x, 3).pinhole = grey(1);
    at(blocks, x, 3).mean_coc = at(blocks, x, 3).least_coc = -4;
  }
  EXPECT_EQ(signs_at(blocks, 4, 4)[hidden], 0.0f);
  // And behind it.
  for (int x = 3; x < 6; ++x) {
    PixelBlock& b = at(blocks, x, 3);
    b.mean_coc = b.largest_coc = 0;
    b.least_coc = 0;
  }
  const float behind = signs_at(blocks, 4, 4)[hidden];
  EXPECT_NEAR(behind, 0.25 * (3 / 9.0 - 9 / 81.0), 1e-6);
  EXPECT_EQ(signs_at(blocks, 4, 4)[index_of("the same, without patterns")], behind);
  EXPECT_NEAR(signs_at(blocks, 4, 4)[index_of("unseen contrast behind")], 2 * behind, 1e-6);
}

TEST(Signs, UnseenCountsByTheResultsContrast) {
  PixelBlocks blocks = dark(3, 3);
  at(blocks, 1, 1).unseen = 0.5f;
  at(blocks, 0, 0).result = grey(1);
  EXPECT_NEAR(signs_at(blocks, 1, 1)[index_of("unseen contrast of the result, half size")],
              0.5 * (1 / 9.0 - 1 / 81.0), 1e-6);
}

TEST(Signs, WhatBlocksHoldCountsAsItIs) {
  PixelBlocks blocks = dark(3, 3);
  PixelBlock& b = at(blocks, 1, 1);
  b.rim = 1;
  b.bright_rim = 2;
  b.unseen_rim = 3;
  b.sharp_grain = 4;
  b.slight_grain = 5;
  b.soft_grain = 6;
  b.slight_gradient = 7;
  b.edge_gradient = 8;
  b.lost_grain = 9;
  const SignValues signs = signs_at(blocks, 1, 1);
  const std::pair<const char*, float> expected[] = {{"rims beyond white", 1},
                                                    {"rims beyond 4 times white", 2},
                                                    {"unseen rims", 3},
                                                    {"grain below 0.3 px", 4},
                                                    {"grain to 1 px", 5},
                                                    {"grain, 2.5 to 6 px", 6},
                                                    {"gradient, 0.3 to 2.5 px", 7},
                                                    {"gradient on edges, half size", 8},
                                                    {"grain lost by half size", 9}};
  for (const auto& [name, value] : expected) EXPECT_EQ(signs[index_of(name)], value) << name;
}

TEST(Signs, CrowdsOfEdgesBeforeContrast) {
  const std::size_t crowd = index_of("edges^3 contrast behind");
  PixelBlocks blocks = dark(3, 3);
  at(blocks, 0, 0).pinhole = grey(1);
  at(blocks, 1, 1).edge = 0.5f;
  EXPECT_NEAR(signs_at(blocks, 1, 1)[crowd], 0.125 * (1 / 9.0 - 1 / 81.0), 1e-7);
}

}  // namespace
}  // namespace defray::test::signs_test
