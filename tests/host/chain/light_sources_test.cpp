// What is taken out of a frame as highlights: how much light, from where, listed in which tiles,
// and which lens point stands for which part of the lens.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/random.h"
#include "chain/steps/highlights.h"
#include "lens/aperture_mask.h"
#include "lens/lens_points.h"
#include "support.h"

namespace defray::test::light_sources_test {
namespace {

constexpr int width = 150, height = 100, tile = DEFRAY_LIGHT_TILE;

/// Two layers; every third highlight behind, some of them made up, some shares of their pixel.
struct Scene {
  Frame frame;
  std::vector<float> kept;
  std::vector<std::size_t> sources;

  explicit Scene(std::uint32_t seed, int channels = 3) {
    frame.width = width;
    frame.height = height;
    frame.layers = 2;
    std::vector<std::int32_t> coc(frame.surfaces(), 100);
    Plane depth(frame.surfaces(), 3);
    std::vector<std::uint32_t> coverage(frame.surfaces(), DEFRAY_WHOLE);
    kept.assign(frame.surfaces(), 1);
    Random random(1, 2, seed);
    for (int i = 0; i < 12; ++i) {
      const std::size_t at = frame.index(static_cast<int>(width * random.next()),
                                         static_cast<int>(height * random.next()), i % 3 == 0);
      coc[at] = static_cast<std::int32_t>(256 * (i < 2 ? 90 : 20) * (2 * random.next() - 1));
      depth[at] = static_cast<float>(1 + 5 * random.next());
      coverage[at] = i % 4 == 0   ? 16384
                     : i % 4 == 1 ? DEFRAY_WHOLE | DEFRAY_SYNTHESISED
                                  : DEFRAY_WHOLE;
      kept[at] = static_cast<float>(0.5 * random.next());
      sources.push_back(at);
    }
    std::sort(sources.begin(), sources.end());
    frame.coc_quanta = coc;
    frame.depth = depth;
    frame.coverage = coverage;
    for (int c = 0; c < channels; ++c) {
      frame.channels.emplace_back(
          random_plane({width, 2 * height}, seed + static_cast<std::uint32_t>(c)));
    }
  }
};

const ApertureTable& aperture() {
  static const ApertureTable table = make_aperture_table(rasterise(Aperture{}));
  return table;
}

LightSources taken(Scene& s, int light_channels) {
  return take_light(s.frame, s.kept, light_channels, aperture());
}

TEST(LightSources, AreWhatIsNotKept) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    Scene s(seed);
    const Frame before = s.frame;
    const LightSources lights = taken(s, 3);
    ASSERT_EQ(lights.where.size(), s.sources.size());
    for (std::size_t k = 0; k < s.sources.size(); ++k) {
      const std::size_t i = s.sources[k];
      const auto& [x, y, coc, box] = lights.where[k];
      EXPECT_EQ(x, static_cast<int>(i % width));
      EXPECT_EQ(y, static_cast<int>(i / width / 2));
      EXPECT_EQ(coc, before.coc_quanta[i]);
      EXPECT_EQ(box, 1 + DEFRAY_LIGHT_ROW);  // one pixel
      const double share = (before.coverage[i] & 0x7fffffff) / 65536.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double colour = before.channels[c][i], kept = colour * s.kept[i];
        EXPECT_NEAR(s.frame.channels[c][i], kept, 1e-6 * std::fabs(colour));
        EXPECT_NEAR(lights.excess[k][c], (colour - kept) * share, 1e-6 * std::fabs(colour));
      }
      EXPECT_EQ(lights.excess[k][3], lights.excess[k][2]);  // a missing channel
    }
    EXPECT_NEAR(lights.share_of_light * aperture().total(), 1, 1e-6);
  }
}

TEST(LightSources, AreListedWhereTheirDiscsMayReach) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    Scene s(seed);
    const LightSources lights = taken(s, 3);
    const int across = (width + tile - 1) / tile, down = (height + tile - 1) / tile;
    EXPECT_EQ(lights.tiles_x, across);
    ASSERT_EQ(lights.first.size(), static_cast<std::size_t>(across * down + 1));
    EXPECT_EQ(lights.first.back(), lights.list.size());
    for (int t = 0; t < across * down; ++t) {
      const auto begin = lights.list.begin() + lights.first[static_cast<std::size_t>(t)];
      const auto end = lights.list.begin() + lights.first[static_cast<std::size_t>(t + 1)];
      EXPECT_TRUE(std::is_sorted(begin, end));
      for (std::uint32_t k = 0; k < lights.where.size(); ++k) {
        const auto& [x, y, coc, box] = lights.where[k];
        // From the source to the nearest pixel of the tile.
        const auto off = [](int at, int first) {
          return std::max({first - at, at - first - tile + 1, 0});
        };
        const int away = std::max(off(x, t % across * tile), off(y, t / across * tile));
        const double radius = std::abs(coc) / 256.0;
        const bool is_listed = std::find(begin, end, k) != end;
        if (away <= radius + 1) {
          EXPECT_TRUE(is_listed) << t << " " << k;
        }
        if (away > radius + 2) {
          EXPECT_FALSE(is_listed) << t << " " << k;
        }
      }
    }
  }
}

TEST(LightSources, AlphaBelongsToTheLightAsFarAsItStandsOut) {
  // A light of alpha 1 on glass of alpha 0.25 that covers more than half of what is around it; on
  // another, less than half.
  for (const auto& [glass_from, around] : {std::pair{60, 0.25f}, {80, 0.0f}}) {
    Scene s(1, 4);
    s.kept.assign(s.kept.size(), 1);
    const std::size_t light = s.frame.index(75, 50, 0);
    s.kept[light] = 0;
    std::vector<std::int32_t> coc(s.frame.surfaces(), 10 * 256);
    s.frame.coc_quanta = coc;
    Plane alpha(s.frame.surfaces());
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      alpha[i] = static_cast<int>(i % width) >= glass_from ? 0.25f : 0;
    }
    alpha[light] = 1;
    s.frame.channels[3] = alpha;
    const std::uint32_t half = 32768;
    std::vector<std::uint32_t> coverage(s.frame.surfaces(), half);
    s.frame.coverage = coverage;
    const LightSources lights = taken(s, 3);
    ASSERT_EQ(lights.excess.size(), 1u);
    EXPECT_EQ(lights.excess[0][3], (1 - around) / 2);
    EXPECT_EQ(s.frame.channels[3][light], around);
    // Of what keeps a part of its light no more alpha goes than light.
    alpha[light] = 1;
    s.frame.channels[3] = alpha;
    s.kept[light] = 0.625f;
    taken(s, 3);
    EXPECT_EQ(s.frame.channels[3][light], 0.625f);
  }
}

TEST(LightSources, AroundALightInFocusLiesWhatIsThreePixelsOff) {
  // Half of what is looked at lies 5 px away, half of those 3 px and 2.
  for (const auto& [nearest, farthest, around] :
       {std::tuple{4.9, 5.7, 0.25f}, {2.8, 4.5, 0.25f}, {4.6, 4.8, 0.0f}, {5.8, 9.0, 0.0f}}) {
    Scene s(1, 4);
    s.kept.assign(s.kept.size(), 1);
    const std::size_t light = s.frame.index(75, 50, 0);
    s.kept[light] = 0;
    std::vector<std::int32_t> coc(s.frame.surfaces());
    s.frame.coc_quanta = coc;
    Plane alpha(s.frame.surfaces());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double away = std::hypot(x - 75, y - 50);
        alpha[s.frame.index(x, y, 0)] = away >= nearest && away <= farthest ? 0.25f : 0;
      }
    }
    alpha[light] = 1;
    s.frame.channels[3] = alpha;
    taken(s, 3);
    EXPECT_EQ(s.frame.channels[3][light], around) << nearest;
  }
}

TEST(LightSources, InACornerTheFramesFirstAndLastPixelsAreLookedAt) {
  // Only the frame's border has alpha; from a corner half of what is looked at lies on it.
  for (const auto& [x, y] :
       {std::pair{0, 0}, {width - 1, 0}, {0, height - 1}, {width - 1, height - 1}}) {
    Scene s(1, 4);
    s.kept.assign(s.kept.size(), 1);
    const std::size_t light = s.frame.index(x, y, 0);
    s.kept[light] = 0;
    s.frame.coc_quanta = std::vector<std::int32_t>(s.frame.surfaces());
    Plane alpha(s.frame.surfaces());
    for (int k = 0; k < width; ++k) alpha[s.frame.index(k, y, 0)] = 0.25f;
    for (int k = 0; k < height; ++k) alpha[s.frame.index(x, k, 0)] = 0.25f;
    alpha[light] = 1;
    s.frame.channels[3] = alpha;
    taken(s, 3);
    // Four places of ten: at 3.5 and 5 px along each side.
    EXPECT_EQ(s.frame.channels[3][light], 0.0f) << x << " " << y;
    for (float& a : alpha) a = a > 0 ? 0.5f : 0;
    for (int k = 1; k < 4; ++k) alpha[s.frame.index(x ? x - k : k, y ? y - k : k, 0)] = 0.5f;
    alpha[light] = 1;
    s.frame.channels[3] = alpha;
    taken(s, 3);
    EXPECT_EQ(s.frame.channels[3][light], 0.5f) << x << " " << y;
  }
}

TEST(LightSources, MapsHaveAnEntryAPixelOfTheDiscUpTo64ASide) {
  Scene s(2);
  const LightSources lights = taken(s, 3);
  ASSERT_EQ(lights.maps.size(), lights.where.size());
  int entries = 0, without = 0;
  for (std::size_t k = 0; k < lights.maps.size(); ++k) {
    const int across = 2 * (std::abs(lights.where[k][2]) / 256);
    const bool is_in_front = lights.where[k][2] < 0;  // of all others: it has no map
    without += is_in_front;
    EXPECT_EQ(lights.maps[k][0], is_in_front ? 0 : entries);
    EXPECT_EQ(lights.maps[k][1], is_in_front ? 0 : std::min(across + 2, 64));
    entries += lights.maps[k][1] * lights.maps[k][1];
  }
  EXPECT_GT(without, 2);
  EXPECT_GT(entries, 1000);
  EXPECT_EQ(lights.map_entries, static_cast<std::size_t>(entries));
}

TEST(LightSources, TooManyMapsAreRefused) {
  LightSources all;
  for (int i = 0; i < 525000; ++i) {  // 64 x 64 bytes each
    all.where.push_back({i % 1000 * 4, i / 1000 * 4, 60 * 256, 1 + DEFRAY_LIGHT_ROW});
    all.excess.push_back({1, 1, 1, 0});
  }
  Frame f;
  f.width = 4000;
  f.height = 2100;
  f.coc_quanta = Quanta(std::vector<std::int32_t>(f.pixels()));
  try {
    lights_near(all, f, f.height);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find("525000 highlights are too many so far out of focus"), 0u);
  }
}

}  // namespace
}  // namespace defray::test::light_sources_test
