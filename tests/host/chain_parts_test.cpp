// What the chain's host code decides, pixel by pixel against its definition, on random frames:
// tiles to fill, whose data a surface has, what the report counts, how far matches move a colour.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "chain/fill_tiles.h"
#include "chain/layers.h"
#include "chain/pattern_window.h"
#include "support.h"

namespace defray::test {
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

TEST(FillTiles, AreThoseFromWhichAWayCanMeetAMixedPixel) {
  constexpr Size size{173, 150};
  constexpr int across = 11, down = 10;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const auto coc = tile_coc(size, seed % 2 ? -8 : -30, seed < 3 ? 20 : 60, seed);
    std::vector<std::uint32_t> mixed(coc.size());
    Random random(3, 4, seed);
    for (int i = 0; i < 3; ++i) mixed[static_cast<std::size_t>(random.next() * coc.size())] = 1;
    const Frame f{size.width, size.height, coc};
    const Words active = tiles_to_fill(f, mixed);
    ASSERT_EQ(active.size(), static_cast<std::size_t>(across * down));
    const int farthest = *std::max_element(coc.begin(), coc.end());
    for (int i = 0; i < across * down; ++i) {
      const int tx = i % across, ty = i / across;
      // Ways of `fill` from this tile go so far, in whole tiles.
      const int own = coc[f.index(tx * tile, ty * tile)];
      const int reach = ((farthest - own) / 256 + 2) / tile + 1;
      bool is_near = false;
      for (std::size_t k = 0; k < mixed.size(); ++k) {
        const int x = static_cast<int>(k) % size.width / tile;
        const int y = static_cast<int>(k) / size.width / tile;
        is_near |= mixed[k] && std::max(std::abs(x - tx), std::abs(y - ty)) <= reach;
      }
      EXPECT_EQ(active[static_cast<std::size_t>(i)], is_near) << tx << " " << ty << " " << seed;
    }
  }
}

TEST(FillTiles, TheNearestAndTheFarthestPixelCount) {
  // A tile's nearest pixel looks the farthest; radii beyond 2^20 px count as that.
  std::vector<std::int32_t> coc(160 * 16, 2560);
  std::vector<std::uint32_t> mixed(coc.size());
  mixed[5] = 1;
  const auto active = [&] {
    const Words flags = tiles_to_fill({160, 16, coc}, mixed);
    return std::count(flags.begin(), flags.end(), 1u);
  };
  EXPECT_EQ(active(), 2);  // 2 px: no more than the next tile
  coc[40] = -2560;         // in the third tile, 22 px in front of the rest
  EXPECT_EQ(active(), 3);
  coc[159] = 1 << 30;
  EXPECT_EQ(active(), 10);
}

/// A frame of a few surfaces, and its layers as `split` may leave them.
struct LayerScene {
  static constexpr int width = 23, height = 17, margin = 2;
  Frame frame;
  Surfaces surfaces;

  explicit LayerScene(std::uint32_t seed) {
    Plane inverse, front, behind;
    std::vector<std::int32_t> coc, front_coc, behind_coc;
    std::vector<std::uint32_t> data, front_coverage, behind_coverage;
    for (int i = 0; i < width * height; ++i) {
      Random random(i % width, i / width, seed);
      const auto surface = [&] { return static_cast<int>(25 * random.next()); };
      const int own = surface(), in_front = random.next() < 0.5 ? own : surface();
      inverse.push_back(0.1f * static_cast<float>(own));
      coc.push_back(100 * (own % 4));
      data.push_back(1000u + static_cast<std::uint32_t>(i));
      front.push_back(0.1f * static_cast<float>(in_front));
      front_coc.push_back(100 * (in_front % 4));
      front_coverage.push_back(random.next() < 0.5 ? DEFRAY_WHOLE : 1000);
      const int back = surface();
      const double kind = random.next();
      behind.push_back(kind < 0.3 ? -1 : 0.1f * static_cast<float>(back));
      behind_coc.push_back(100 * (back % 4));
      behind_coverage.push_back(DEFRAY_WHOLE | (kind < 0.7 ? DEFRAY_SYNTHESISED : 0));
    }
    frame.width = width;
    frame.height = height;
    frame.margin = margin;
    surfaces.front = surfaces.behind = frame.without_planes();
    frame.inverse = inverse;
    frame.coc_quanta = coc;
    frame.data_of = data;
    set(surfaces.front, front, front_coc, front_coverage);
    set(surfaces.behind, behind, behind_coc, behind_coverage);
  }
  static void set(Frame& f, Plane inverse, std::vector<std::int32_t> coc,
                  std::vector<std::uint32_t> coverage) {
    f.inverse = std::move(inverse);
    f.coc_quanta = std::move(coc);
    f.coverage = std::move(coverage);
  }

  /// Its own pixel's, or that of the nearest pixel on this surface up to 3 px away.
  std::uint32_t expected_data(const Frame& layer, std::size_t i) const {
    std::set<std::pair<int, std::size_t>> on_surface;
    for (std::size_t k = 0; k < frame.pixels(); ++k) {
      const int dx = static_cast<int>(k % width) - static_cast<int>(i % width);
      const int dy = static_cast<int>(k / width) - static_cast<int>(i / width);
      const bool is_on =
          frame.inverse[k] == layer.inverse[i] && frame.coc_quanta[k] == layer.coc_quanta[i];
      if (is_on && std::max(std::abs(dx), std::abs(dy)) <= 3) {
        on_surface.insert({dx * dx + dy * dy, k});
      }
    }
    return on_surface.empty() ? DEFRAY_EMPTY : frame.data_of[on_surface.begin()->second];
  }
};

TEST(Layers, DataAreThoseOfTheNearestPixelOnTheSurface) {
  int from_beside = 0, from_nowhere = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const LayerScene s(seed);
    ChainReport report;
    const Frame two = two_layers(twins(), s.frame, s.surfaces, report);
    for (std::size_t i = 0; i < s.frame.pixels(); ++i) {
      const int x = static_cast<int>(i) % LayerScene::width,
                y = static_cast<int>(i) / LayerScene::width;
      const std::uint32_t front = s.expected_data(s.surfaces.front, i);
      EXPECT_EQ(two.data_of[two.index(x, y, 0)], front);
      from_beside += front != s.frame.data_of[i];
      const bool is_made_up = s.surfaces.behind.coverage[i] >= DEFRAY_SYNTHESISED;
      const std::uint32_t behind =
          is_made_up ? DEFRAY_EMPTY : s.expected_data(s.surfaces.behind, i);
      EXPECT_EQ(two.data_of[two.index(x, y, 1)], behind);
      from_nowhere += !is_made_up && behind == DEFRAY_EMPTY;
    }
  }
  EXPECT_GT(from_beside, 100);
  EXPECT_GT(from_nowhere, 10);
}

TEST(Layers, TheReportCountsThePicturesPixelsAlone) {
  const LayerScene s(9);
  ChainReport report;
  two_layers(twins(), s.frame, s.surfaces, report);
  std::size_t split = 0, behind = 0;
  for (int y = LayerScene::margin; y < LayerScene::height - LayerScene::margin; ++y) {
    for (int x = LayerScene::margin; x < LayerScene::width - LayerScene::margin; ++x) {
      const std::size_t i = s.frame.index(x, y);
      split += s.surfaces.front.coverage[i] == 1000;
      behind += s.surfaces.behind.inverse[i] >= 0 &&
                s.surfaces.behind.coverage[i] == (DEFRAY_WHOLE | DEFRAY_SYNTHESISED);
    }
  }
  EXPECT_EQ(report.split, split);
  EXPECT_EQ(report.behind, behind);
  // No share where nothing is.
  LayerScene none(9);
  none.surfaces.front.inverse = Plane(none.frame.pixels(), -1);
  ChainReport empty;
  two_layers(twins(), none.frame, none.surfaces, empty);
  EXPECT_EQ(empty.split, 0u);
}

TEST(Layers, OfWholePixelsThoseInTheMarginAreMadeUp) {
  LayerScene s(2);
  Plane inverse(s.frame.pixels(), 0.25f);
  inverse[30] = 0;
  inverse[31] = -1;
  s.frame.inverse = inverse;
  const Frame f = whole_pixels(s.frame);
  EXPECT_EQ(f.depth[29], 4);
  EXPECT_TRUE(std::isinf(f.depth[30]) && f.depth[30] > 0);
  EXPECT_FALSE(is_fragment(f.depth[31]));
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    EXPECT_EQ(f.coverage[i], DEFRAY_WHOLE | (f.is_in_margin(i) ? DEFRAY_SYNTHESISED : 0)) << i;
  }
}

/// Matches that lie 0.6 away, in sums of two shifts; surroundings that differ by D.
float moved(double difference_squared, double variance) {
  PatternSums sums(1, 1);
  sums.difference[0][0] = 3 * 0.6f;
  sums.weight[0] = 3;
  sums.weighted_square[0] = static_cast<float>(3 * difference_squared);
  Planes behind{Plane{0.5f}};
  blend_patterns(std::vector<std::uint32_t>{DEFRAY_PATTERN_BEHIND}, sums,
                 {static_cast<float>(variance)}, behind);
  return behind[0][0] - 0.5f;
}

TEST(PatternGain, IsTheShareOfTheVarianceThatMatchesExplain) {
  constexpr double variance = 40;
  // D = 2 (V - covariance): unlike by chance alone, half explained, all of it.
  for (const double explained : {0.0, 0.25, 0.5, 1.0}) {
    const double covariance = explained * variance;
    EXPECT_NEAR(moved(2 * (variance - covariance), variance), 0.6 * explained, 1e-6);
  }
  EXPECT_EQ(moved(3 * variance, variance), 0);
  EXPECT_EQ(moved(0, 0), 0);
}

/// Cells of a grid over a window of which a pixel is wanted.
using Cells = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Cells cells_of(const std::vector<PatternUnit>& units) {
  Cells cells;
  for (const PatternUnit& u : units) cells.insert({u.x, u.y});
  EXPECT_EQ(cells.size(), units.size());
  return cells;
}

TEST(PatternUnits, AreThoseNearSomethingHidden) {
  constexpr int n = 5, run = DEFRAY_PATTERN_RUN, wide = DEFRAY_PATTERN_COLUMNS;
  const Frame frame{150, 200, std::vector<std::int32_t>(150 * 200)};
  PatternSettings settings;
  settings.window_px = n;
  const PatternMargins margins({{-9, 3}, {4, -12}}, n);
  const DefrayPatternParams p = pattern_band(frame, margins, settings, 30, 140);
  const int left = static_cast<int>(p.margin_x), top = static_cast<int>(p.margin_y);
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    Random random(1, 1, seed);
    std::vector<std::uint32_t> pixels((140 + 2 * size(top)) * p.stride);
    Cells match, columns, difference;
    for (int i = 0; i < 4; ++i) {
      const int x = static_cast<int>(150 * random.next()),
                y = static_cast<int>(140 * random.next());
      pixels[size(y + top) * p.stride + size(x + left)] = DEFRAY_PATTERN_BEHIND;
      match.insert({word(left + x / DEFRAY_PATTERN_CHUNK * DEFRAY_PATTERN_CHUNK), word(top + y)});
      for (int column = left + x - n + 1; column < left + x + n; ++column) {
        columns.insert({word(column / wide * wide),
                        word(top + y / DEFRAY_PATTERN_STRIP * DEFRAY_PATTERN_STRIP)});
      }
    }
    for (const auto& [x, y] : columns) {
      const int end = std::min(static_cast<int>(y) + DEFRAY_PATTERN_STRIP, top + 140);
      for (int row = static_cast<int>(y) - n + 1; row < end + n - 1; ++row) {
        difference.insert({x / run * run, word(row)});
      }
    }
    const PatternUnits units = pattern_units(p, pixels);
    EXPECT_EQ(cells_of(units.match), match);
    EXPECT_EQ(cells_of(units.columns), columns);
    EXPECT_EQ(cells_of(units.difference), difference);
  }
}

}  // namespace
}  // namespace defray::test
