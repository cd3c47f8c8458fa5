// What the chain's host code decides, pixel by pixel against its definition, on random frames:
// tiles to fill, units of `patterns` to compute, how far matches move a colour.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/random.h"
#include "chain/patterns/patterns_cells.h"
#include "chain/tiles/fill_tiles.h"
#include "chain/tiles/highlight_tiles.h"
#include "support.h"

namespace defray::test::chain_parts_test {
namespace {

constexpr int tile = DEFRAY_FILL_TILE;

/// Far surfaces in most tiles, and one near one: their CoC radii decide how far ways lead.
std::vector<std::int32_t> tile_coc(Size size, double near_px, double far_px, std::uint32_t seed) {
  std::vector<std::int32_t> coc;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      Random random(x / tile, y / tile, seed);
      const double px = near_px + (far_px - near_px) * std::pow(random.next(), 2);
      coc.push_back(static_cast<std::int32_t>(256 * px));
    }
  }
  return coc;
}

/// All that a way of `fill` can end on: pixels close enough to be seen past what is in front, and
/// whether a mixed one lies on the way there. Tile by tile, from each pixel.
struct Met {
  std::int32_t farthest = DEFRAY_NOTHING_BEHIND;
  bool is_mixed_near = false;
};

Met met_from(const Frame& f, const Words& mixed, int x, int y) {
  Met met;
  const int own = f.coc_quanta[f.index(x, y)];
  for (int v = 0; v < f.height; ++v) {
    for (int u = 0; u < f.width; ++u) {
      const int coc = f.coc_quanta[f.index(u, v)];
      const int away = std::max(std::abs(u - x), std::abs(v - y));
      if (coc > own && away <= (coc - own) / 256 + 2) met.farthest = std::max(met.farthest, coc);
    }
  }
  const int reach = met.farthest == DEFRAY_NOTHING_BEHIND ? 0 : (met.farthest - own) / 256 + 2;
  for (int v = std::max(0, y - reach); v <= std::min(f.height - 1, y + reach); ++v) {
    for (int u = std::max(0, x - reach); u <= std::min(f.width - 1, x + reach); ++u) {
      met.is_mixed_near |= mixed[f.index(u, v)] != 0;
    }
  }
  return met;
}

TEST(FillTiles, KnowTheFarthestThatAWayCanMeet) {
  constexpr Size size{93, 70};
  constexpr int across = 6, down = 5;
  int nothing = 0, less_than_all = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const auto coc = tile_coc(size, seed % 2 ? -8 : -30, seed < 3 ? 5 : 30, seed);
    std::vector<std::uint32_t> mixed(coc.size());
    Random random(3, 4, seed);
    for (int i = 0; i < 3; ++i) mixed[static_cast<std::size_t>(random.next() * coc.size())] = 1;
    const Frame f{size.width, size.height, coc};
    const Quanta farthest = farthest_to_fill(f, mixed);
    ASSERT_EQ(farthest.size(), static_cast<std::size_t>(across * down));
    const int all = *std::max_element(coc.begin(), coc.end());
    for (int y = 0; y < size.height; y += 3) {
      for (int x = 0; x < size.width; x += 3) {
        const Met met = met_from(f, mixed, x, y);
        const int known = farthest[static_cast<std::size_t>(y / tile * across + x / tile)];
        if (met.is_mixed_near) {
          EXPECT_GE(known, met.farthest) << x << " " << y << " " << seed;
        }
        EXPECT_LE(known, all);
      }
    }
    for (const std::int32_t known : farthest) {
      nothing += known == DEFRAY_NOTHING_BEHIND;
      less_than_all += known != DEFRAY_NOTHING_BEHIND && known < all;
    }
  }
  EXPECT_GT(nothing, 10);
  EXPECT_GT(less_than_all, 10);
}

TEST(FillTiles, TheNearestAndTheFarthestPixelCount) {
  // A tile's nearest pixel looks the farthest; radii beyond 2^20 px count as that.
  std::vector<std::int32_t> coc(160 * 16, 2560);
  std::vector<std::uint32_t> mixed(coc.size());
  mixed[5] = 1;
  const auto active = [&] {
    const Quanta farthest = farthest_to_fill({160, 16, coc}, mixed);
    return 10 - std::count(farthest.begin(), farthest.end(), DEFRAY_NOTHING_BEHIND);
  };
  EXPECT_EQ(active(), 2);  // 2 px: no more than the next tile
  coc[40] = -2560;         // in the third tile, 22 px in front of the rest
  EXPECT_EQ(active(), 3);
  coc[159] = 1 << 30;
  EXPECT_EQ(active(), 10);
}

/// How far a pixel is from those of all runs of a row that begin in a cell.
int away_from_runs(int x, int y, int cell_x, int cell_y) {
  const int left = cell_x * DEFRAY_FILL_CELL, right = left + DEFRAY_FILL_CELL + DEFRAY_RUN - 2;
  const int top = cell_y * DEFRAY_FILL_CELL, bottom = top + DEFRAY_FILL_CELL - 1;
  return std::max({0, left - x, x - right, top - y, y - bottom});
}

/// `fill` passes over what lies within: a mixed pixel there would be missed.
TEST(FillTiles, SoManyPixelsAroundARunNoneIsMixedAndNoFewerByMuch) {
  constexpr int width = 93, height = 70, across = 24, down = 18;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    std::vector<std::uint32_t> mixed(size(width) * size(height));
    Random random(1, 2, seed);
    std::vector<std::array<int, 2>> places;
    for (int i = 0; i < 3; ++i) {
      const auto& [x, y] = places.emplace_back(std::array{
          static_cast<int>(random.next() * width), static_cast<int>(random.next() * height)});
      mixed[size(y * width + x)] = 1;
    }
    const auto pure =
        pure_around_runs({width, height, std::vector<std::int32_t>(mixed.size())}, mixed);
    ASSERT_EQ(pure.size(), size(across * down));
    for (int y = 0; y < down; ++y) {
      for (int x = 0; x < across; ++x) {
        int away = width;
        for (const auto& place : places) {
          away = std::min(away, away_from_runs(place[0], place[1], x, y));
        }
        const int around = pure[size(y * across + x)];
        EXPECT_LE(around, std::max(0, away - 1)) << x << " " << y << " " << seed;
        EXPECT_GE(around, away - DEFRAY_FILL_CELL - 1) << x << " " << y << " " << seed;
      }
    }
  }
}

/// Two layers of random light, some of it not a number, some fragments made up.
Frame lit_frame(Size size, std::uint32_t seed, int coc_px) {
  Frame f{size.width, size.height};
  f.layers = 2;
  Random random(5, 6, seed);
  std::vector<std::int32_t> coc;
  std::vector<std::uint32_t> coverage;
  std::vector<float> dim, bright;
  for (std::size_t i = 0; i < f.surfaces(); ++i) {
    const bool is_wide = random.next() < 0.01;
    coc.push_back(static_cast<std::int32_t>(256 * (is_wide ? -coc_px : 1) * random.next()));
    coverage.push_back(DEFRAY_WHOLE | (random.next() < 0.3 ? DEFRAY_SYNTHESISED : 0));
    dim.push_back(static_cast<float>(random.next()) - 0.1f);
    const bool is_number = random.next() < 0.9;
    bright.push_back(is_number ? 1 + static_cast<float>(random.next()) : std::nanf(""));
  }
  f.coc_quanta = coc;
  f.coverage = coverage;
  f.channels = {Values<float>(dim), Values<float>(bright)};
  return f;
}

TEST(HighlightTiles, KnowTheDarkestThatAFragmentLooksAt) {
  constexpr Size size{75, 50};
  constexpr int across = 5;
  for (const int coc_px : {2, 20, 400}) {
    const Frame f = lit_frame(size, 3, coc_px);
    const Values<float> darkest = darkest_around(f, 2);
    ASSERT_EQ(darkest.size(), 20u);
    const auto light = [&](int x, int y) {
      const std::size_t i = f.index(x, y, 0);
      if (f.coverage[i] >= DEFRAY_SYNTHESISED) return HUGE_VALF;
      return std::fmax(f.channels[0][i], f.channels[1][i]);
    };
    for (int i = 0; i < 32; ++i) {  // fragments beside borders of tiles
      const int x = 16 * (i % 4) + i / 4 % 2 * 15, y = 16 * (i / 8) % 48 + i % 3;
      for (int layer = 0; layer < 2; ++layer) {
        const double radius = std::abs(f.coc_quanta[f.index(x, y, layer)]) / 256.0;
        const double reach = std::max(radius, 3.0) + 2.5;
        float least = HUGE_VALF;
        for (int v = 0; v < size.height; ++v) {
          for (int u = 0; u < size.width; ++u) {
            const bool is_near = std::abs(u - x) <= reach && std::abs(v - y) <= reach;
            if (is_near) least = std::fmin(least, light(u, v));
          }
        }
        EXPECT_LE(darkest[static_cast<std::size_t>(y / 16 * across + x / 16)], least)
            << x << " " << y << " " << coc_px;
      }
    }
  }
}

TEST(HighlightTiles, FarTilesDoNotMatterToSmallDiscs) {
  Frame f{80, 16};
  f.coc_quanta = Quanta(f.surfaces(), 512);
  f.coverage = Words(f.surfaces(), DEFRAY_WHOLE);
  std::vector<float> light(f.surfaces(), 1.0f);
  light[79] = 0.25f;
  f.channels = {Values<float>(light)};
  const Values<float> darkest = darkest_around(f, 1);
  EXPECT_EQ(std::vector<float>(darkest.begin(), darkest.end()),
            (std::vector<float>{1, 1, 1, 0.25f, 0.25f}));
}

TEST(PatternPairs, TheFramesMeanCountsAsAShareOfAWindows) {
  for (int n = 1; n <= DEFRAY_PATTERN_LARGEST_WINDOW; ++n) {
    double weights = 0;
    for (int x = 0; x < DEFRAY_PATTERN_CELL * (2 * n - 1); ++x) {
      weights += n - std::abs(x / DEFRAY_PATTERN_CELL - (n - 1));
    }
    EXPECT_FLOAT_EQ(frame_pairs(n), static_cast<float>(0.015 * weights * weights)) << n;
  }
}

TEST(PatternUnits, OnePixelIsEnough) {
  const Frame frame{40, 9, std::vector<std::int32_t>(360)};
  for (const int x : {0, 15, 16, 39}) {
    for (const int y : {0, 3, 8}) {
      std::vector<std::uint32_t> pixels(frame.pixels(), DEFRAY_PATTERN_KNOWN);
      pixels[frame.index(x, y)] |= DEFRAY_PATTERN_BEHIND;
      const Words needed = needed_units(frame, pixels, 1);
      const std::size_t unit =
          size(y / DEFRAY_PATTERN_CELL) * size(pattern_units(40)) + size(x / DEFRAY_RUN);
      for (std::size_t i = 0; i < needed.size(); ++i)
        EXPECT_EQ(needed[i], i == unit) << x << " " << y;
    }
  }
}

TEST(PatternUnits, AreThoseInTheWindowsOfWhatHidesSomething) {
  const Frame frame{151, 202, std::vector<std::int32_t>(151 * 202)};
  const int units = pattern_units(frame.width), rows = pattern_rows(frame.height);
  EXPECT_EQ(units, 10);
  EXPECT_EQ(rows, 51);
  for (const int n : {1, 2, 5, 6}) {
    Random random(1, n, 3);
    std::vector<std::uint32_t> pixels(frame.pixels(), DEFRAY_PATTERN_KNOWN);
    std::vector<std::array<int, 2>> hiding;
    for (int i = 0; i < 4; ++i) {
      const int x = static_cast<int>(151 * random.next()),
                y = static_cast<int>(202 * random.next());
      pixels[frame.index(x, y)] |= DEFRAY_PATTERN_BEHIND;
      hiding.push_back({x / DEFRAY_RUN, y / DEFRAY_PATTERN_CELL});
    }
    const Words needed = needed_units(frame, pixels, n);
    ASSERT_EQ(needed.size(), size(units) * size(rows));
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < units; ++i) {
        const bool is_near = std::any_of(hiding.begin(), hiding.end(), [&](const auto& unit) {
          // Cells between the nearest of both.
          const int apart = std::max(0, (std::abs(i - unit[0]) - 1) * DEFRAY_PATTERN_UNIT + 1);
          return (i == unit[0] || apart < n) && std::abs(j - unit[1]) < n;
        });
        EXPECT_EQ(needed[size(j) * size(units) + size(i)], is_near) << n << " " << i << " " << j;
      }
    }
  }
}

}  // namespace
}  // namespace defray::test::chain_parts_test
