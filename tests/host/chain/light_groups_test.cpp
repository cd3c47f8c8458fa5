// Highlights that lie together as one source: which, what box, and that no light is lost.
#include "chain/steps/light_groups.h"

#include <cmath>

#include "base/random.h"
#include "chain/plan/chain_bands.h"
#include "chain/steps/highlights.h"
#include "support.h"

namespace defray::test::light_groups_test {
namespace {

constexpr std::int32_t px = 256, pixel = 1 + DEFRAY_LIGHT_ROW;

struct Source {
  std::int32_t x, y, coc;
  std::array<float, 4> light;
};

LightSources grouped(const std::vector<Source>& sources) {
  LightSources lights;
  for (const Source& s : sources) {
    lights.where.push_back({s.x, s.y, s.coc, pixel});
    lights.excess.push_back(s.light);
  }
  group_lights(lights);
  return lights;
}

/// Pixels of a rectangle.
std::vector<Source> rectangle(int left, int top, int right, int bottom, std::int32_t coc) {
  std::vector<Source> out;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) out.push_back({x, y, coc, {3, 2, 1, 0.5f}});
  }
  return out;
}

using Where = std::array<std::int32_t, 4>;

TEST(LightGroups, SquaresAreTheLargerTheMoreBlurred) {
  for (const int sign : {1, -1}) {
    EXPECT_EQ(grouped(rectangle(0, 0, 8, 8, sign * (12 * px - 1))).where.size(), 64u);
    EXPECT_EQ(grouped(rectangle(0, 0, 8, 8, sign * 12 * px)).where.size(), 16u);
    EXPECT_EQ(grouped(rectangle(0, 0, 8, 8, sign * (48 * px - 1))).where.size(), 16u);
    EXPECT_EQ(grouped(rectangle(0, 0, 8, 8, sign * 48 * px)).where.size(), 4u);
  }
}

TEST(LightGroups, BoxesEndWhereTheirPixelsDo) {
  // Columns 3 to 8, rows 6 to 9, in squares of four.
  const LightSources lights = grouped(rectangle(3, 6, 9, 9, 60 * px));
  const auto box = [](int across, int down) { return across + DEFRAY_LIGHT_ROW * down; };
  const std::vector<Where> expected{{3, 6, 60 * px, box(1, 2)}, {4, 6, 60 * px, box(4, 2)},
                                    {8, 6, 60 * px, box(1, 2)}, {3, 8, 60 * px, box(1, 1)},
                                    {4, 8, 60 * px, box(4, 1)}, {8, 8, 60 * px, box(1, 1)}};
  EXPECT_EQ(lights.where, expected);
  for (const auto& light : lights.excess) EXPECT_EQ(light, (std::array{3.0f, 2.0f, 1.0f, 0.5f}));
}

TEST(LightGroups, NoLightIsLost) {
  std::vector<Source> sources;
  Random random(1, 2, 3);
  std::array<double, 4> all{};
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&](double most) { return most * random.next(); };
    Source s{static_cast<int>(any(40)),
             static_cast<int>(any(30)),
             static_cast<int>((any(140) - 70) * px),
             {}};
    s.coc = s.coc / (8 * px) * (8 * px);
    for (std::size_t c = 0; c < 4; ++c)
      all[c] += double{s.light[c] = static_cast<float>(1 + any(0.2))};
    sources.push_back(s);
  }
  const LightSources lights = grouped(sources);
  EXPECT_LT(lights.where.size(), 1700u);
  std::array<double, 4> found{};
  for (std::size_t i = 0; i < lights.where.size(); ++i) {
    const int box = lights.where[i][3], pixels = box % DEFRAY_LIGHT_ROW * (box / DEFRAY_LIGHT_ROW);
    EXPECT_LE(box % DEFRAY_LIGHT_ROW, DEFRAY_LIGHT_GROUP);
    EXPECT_LE(box / DEFRAY_LIGHT_ROW, DEFRAY_LIGHT_GROUP);
    for (std::size_t c = 0; c < 4; ++c) found[c] += double{lights.excess[i][c]} * pixels;
  }
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(found[c] / all[c], 1, 1e-6);
}

TEST(LightGroups, WhatDiffersStaysApart) {
  const Source a{0, 0, 20 * px, {1, 1, 1, 0}};
  const auto together = [&](Source b) { return grouped({a, b}).where.size() == 1; };
  // An eighth of a pixel for each of two.
  EXPECT_TRUE(together({1, 1, 20 * px + 64, {1, 1, 1, 0}}));
  EXPECT_FALSE(together({1, 1, 20 * px + 65, {1, 1, 1, 0}}));
  EXPECT_FALSE(together({1, 1, -20 * px, {1, 1, 1, 0}}));
  EXPECT_FALSE(together({2, 1, 20 * px, {1, 1, 1, 0}}));
  EXPECT_FALSE(together({1, 2, 20 * px, {1, 1, 1, 0}}));
  // A fifth of the brighter one's light.
  EXPECT_TRUE(together({1, 0, 20 * px, {1.24f, 1.24f, 1.24f, 0}}));
  EXPECT_FALSE(together({1, 0, 20 * px, {1.26f, 1.26f, 1.26f, 0}}));
  EXPECT_FALSE(together({1, 0, 20 * px, {1, 1, 0.79f, 0}}));
  EXPECT_FALSE(together({1, 0, 20 * px, {1, 1, 1, 0.21f}}));
  // What is not finite joins nothing.
  for (const float odd : {INFINITY, NAN}) {
    const Source b{0, 0, 20 * px, {odd, 1, 1, 0}}, c{1, 0, 20 * px, {odd, 1, 1, 0}};
    EXPECT_EQ(grouped({b, c}).where.size(), 2u) << odd;
    EXPECT_EQ(grouped({a, c}).where.size(), 2u) << odd;
  }
}

TEST(LightGroups, CocsAreMeans) {
  const LightSources lights = grouped({{0, 0, 20 * px, {1, 1, 1, 1}},
                                       {1, 0, 20 * px + 30, {1, 1, 1, 1}},
                                       {0, 1, 20 * px + 60, {1.2f, 1.2f, 1.2f, 1.2f}}});
  ASSERT_EQ(lights.where.size(), 1u);
  EXPECT_EQ(lights.where[0], (Where{0, 0, 20 * px + 30, 2 + 2 * DEFRAY_LIGHT_ROW}));
  EXPECT_FLOAT_EQ(lights.excess[0][2], 3.2f / 4);  // spread over the box, whose corner has none
}

/// What shines on tiles of wanted rows: boxes, CoCs and light, tile by tile.
std::vector<std::pair<Where, std::array<float, 4>>> shining(const LightSources& lights, Rows rows) {
  std::vector<std::pair<Where, std::array<float, 4>>> out;
  for (int ty = rows.y / DEFRAY_LIGHT_TILE; ty < rows.end / DEFRAY_LIGHT_TILE; ++ty) {
    const auto tile = static_cast<std::size_t>(ty * lights.tiles_x);
    for (std::size_t i = lights.first[tile]; i < lights.first[tile + 1]; ++i) {
      const std::uint32_t source = lights.list[i];
      out.emplace_back(lights.where[source], lights.excess[source]);
    }
  }
  return out;
}

TEST(LightGroups, BandsHaveThoseOfTheWholeFrame) {
  for (int step = 0; step < 3; ++step) {  // from the band's end to the nearest row of light
    Frame f;
    f.width = 40;
    f.height = 512;
    const std::int32_t coc = 55 * px + 255;
    f.coc_quanta = std::vector<std::int32_t>(f.surfaces(), coc);
    LightSources all;
    for (const Source& s : rectangle(0, 256 + 54 + step, 4, 512, coc)) {
      all.where.push_back({s.x, s.y, s.coc, pixel});
      all.excess.push_back(s.light);
    }
    const LightSources whole = lights_near(all, f, f.height);
    ChainSettings settings;
    settings.hidden = Hidden::off;
    f.wanted = Rows{224, 256};
    const LightSources band = lights_near(all, f, chain_reach(f, settings, 137).rays);
    EXPECT_EQ(shining(band, f.wanted_rows()), shining(whole, f.wanted_rows())) << step;
    EXPECT_FALSE(shining(band, f.wanted_rows()).empty()) << step;
  }
}

TEST(LightGroups, BoxesAreListedWhereTheirLastPixelsShine) {
  LightSources lights;
  for (const int box : {pixel, 4 + DEFRAY_LIGHT_ROW * 3}) {
    lights.where.push_back({27, 28, px, box});
    lights.excess.push_back({1, 1, 1, 1});
  }
  sort_into_tiles(lights, 64, 64);
  // Of one pixel's disc the last column and row are 30 and 31; the box's go on to 33.
  EXPECT_EQ(lights.first, (std::vector<std::uint32_t>{0, 2, 3, 4, 5}));
  EXPECT_EQ(lights.list, (std::vector<std::uint32_t>{0, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace defray::test::light_groups_test
