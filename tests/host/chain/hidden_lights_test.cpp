// Which lights anything may hide: none that its map would show hidden is left out.
#include "chain/steps/hidden_lights.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "chain/steps/highlights.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::hidden_lights_test {
namespace {

constexpr int width = 90, height = 70, px = 256;

template <typename CocPx>
Frame frame_of(const CocPx& coc_px, int layers = 1) {
  Frame f;
  f.width = width;
  f.height = height;
  f.layers = layers;
  std::vector<std::int32_t> coc(f.surfaces(), -1000 * px);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      coc[f.index(x, y)] = static_cast<std::int32_t>(std::lround(px * coc_px(x, y)));
    }
  }
  f.coc_quanta = coc;
  return f;
}

LightSources lamp_at(int x, int y, double coc_px, int across = 1, int down = 1) {
  LightSources lights;
  lights.where = {{x, y, static_cast<std::int32_t>(std::lround(px * coc_px)),
                   across + DEFRAY_LIGHT_ROW * down}};
  return lights;
}

bool is_hidden(const LightSources& lights, const Frame& f, Rows rows = {0, height}) {
  return find_hiding(lights, f, rows)[0].has_value();
}

TEST(HiddenLights, AreThoseWithSomethingNearerWithinItsReach) {
  // A post from x = 60 on, 12 px of CoC nearer than a lamp on a wall.
  const Frame f = frame_of([](int x, int) { return x >= 60 && x < 64 ? 8 : 20; }, 2);
  EXPECT_TRUE(is_hidden(lamp_at(50, 30, 20), f));
  EXPECT_FALSE(is_hidden(lamp_at(40, 30, 20), f));
  EXPECT_TRUE(is_hidden(lamp_at(77, 30, 20), f));
  EXPECT_FALSE(is_hidden(lamp_at(78, 30, 20), f));
  // The middle of a box.
  EXPECT_FALSE(is_hidden(lamp_at(45, 30, 20), f));
  EXPECT_TRUE(is_hidden(lamp_at(45, 30, 20, 4), f));
  // In front of the post, and in the post's own depth.
  EXPECT_FALSE(is_hidden(lamp_at(50, 30, -5), f));
  EXPECT_FALSE(is_hidden(lamp_at(62, 30, 8), f));
}

TEST(HiddenLights, LookAtTheRowsThatAreThere) {
  const Frame f = frame_of([](int, int y) { return y == 40 ? 5 : 20; });
  EXPECT_TRUE(is_hidden(lamp_at(50, 30, 20), f));
  EXPECT_TRUE(is_hidden(lamp_at(50, 30, 20), f, {16, 41}));
  EXPECT_FALSE(is_hidden(lamp_at(50, 30, 20), f, {16, 40}));
  EXPECT_FALSE(is_hidden(lamp_at(50, 50, 20), f, {41, 70}));
}

/// Hills of all sizes with steps between them, and lamps everywhere, some larger than a pixel.
TEST(HiddenLights, HaveMapsThatShowIt) {
  int hidden = 0, seen = 0, shown = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    Random random(3, 4, seed);
    const double slope = 0.8 * random.next(), step = 40 * random.next(),
                 wave = 4 + 30 * random.next();
    const double turn = 6.28 * random.next();
    const Frame f = frame_of([&](int x, int y) {
      const double along = x * std::cos(turn) + y * std::sin(turn);
      const double hill = slope * wave * std::sin(x / wave) * std::cos(y / wave);
      return hill + (std::fmod(std::fabs(along), 50) < 12 ? -step : 0) + 5;
    });
    LightSources lights;
    for (int i = 0; i < 30; ++i) {
      const int x = static_cast<int>(width * random.next());
      const int y = static_cast<int>(height * random.next());
      lights.where.push_back({x, y, f.coc_quanta[f.index(x, y)],
                              1 + static_cast<int>(4 * random.next()) +
                                  DEFRAY_LIGHT_ROW * (1 + static_cast<int>(4 * random.next()))});
      lights.maps.push_back({i * 64 * 64, 64, -100 * px, 0});
    }
    lights.map_entries = 30 * 64 * 64;
    const std::vector<std::uint8_t> maps = reference::light_maps(lights, f);
    const auto found = find_hiding(lights, f, {0, height});
    for (int i = 0; i < 30; ++i) {
      const bool shows = std::any_of(maps.begin() + i * 64 * 64, maps.begin() + (i + 1) * 64 * 64,
                                     [](std::uint8_t entry) { return entry != 255; });
      const bool is_found = found[static_cast<std::size_t>(i)].has_value();
      EXPECT_TRUE(is_found || !shows) << seed << " " << i;
      ++(is_found ? hidden : seen);
      shown += shows;
      lights.maps[static_cast<std::size_t>(i)][2] =
          found[static_cast<std::size_t>(i)].value_or(lights.where[static_cast<std::size_t>(i)][2]);
    }
    EXPECT_EQ(reference::light_maps(lights, f), maps) << "ways as far as they must: " << seed;
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(shown, 200);
  EXPECT_LT(hidden, 2 * shown);
}

}  // namespace
}  // namespace defray::test::hidden_lights_test
