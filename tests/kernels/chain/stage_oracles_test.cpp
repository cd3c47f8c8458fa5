// `fill` and `highlights` a second time, on random frames: twins go their kernels' way, these go by
// what the stages are for. What lies behind is known beforehand.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "stages_support.h"

namespace defray::test::stage_oracles_test {
namespace {

/// A plane of one colour that slants any way, and a rectangle in front of it.
struct Plate {
  int x0, y0, x1, y1, coc;
  double slant_x, slant_y;
  double plane(int x, int y) const { return 2500 + slant_x * (x - 32) + slant_y * (y - 24); }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

TEST(Fill, BehindAnyRectangleThePlaneGoesOnAsFarAsTheLensSees) {
  int found = 0, hidden = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    Random random(7, 8, seed);
    const auto any = [&](double low, double high) { return low + (high - low) * random.next(); };
    const Plate p{static_cast<int>(any(8, 20)),
                  static_cast<int>(any(6, 14)),
                  static_cast<int>(any(34, 56)),
                  static_cast<int>(any(26, 42)),
                  static_cast<int>(any(-2000, 500)),
                  any(-15, 15),
                  any(-15, 15)};
    Canvas f(64, 48);
    f.each([&](int x, int y) {
      f.coc[f.at(x, y)] = static_cast<std::int32_t>(std::lround(p.plane(x, y)));
      f.inverse[f.at(x, y)] = static_cast<float>(1 - p.plane(x, y) / 8000);
      f.paint(x, y, 0.25f, 0.5f, 0.75f);
      if (!p.contains(x, y)) return;
      f.coc[f.at(x, y)] = p.coc;
      f.inverse[f.at(x, y)] = 0.95f;
      f.paint(x, y, 1, 0, 1);
    });
    // The colours of mixed pixels count for nothing.
    const Words mixed = f.mixed();
    f.each([&](int x, int y) {
      if (mixed[f.at(x, y)]) f.paint(x, y, 9, 9, 9);
    });
    const Frame behind = device().fill(f.view(), mixed, DEFRAY_FILL_DIRECTIONS);
    const double slant = std::fabs(p.slant_x) + std::fabs(p.slant_y);
    for (int y = p.y0; y < p.y1; ++y) {
      for (int x = p.x0; x < p.x1; ++x) {
        const std::size_t i = f.at(x, y);
        SCOPED_TRACE(testing::Message() << seed << ": " << x << " " << y);
        // Straight out to the four sides; a little less than the reach is surely seen, and past the
        // nearest point nothing is.
        const int out =
            std::min(std::min(x - p.x0, p.x1 - 1 - x), std::min(y - p.y0, p.y1 - 1 - y)) + 1;
        const double reach = (2500 - p.coc) / 256.0, slack = 2 + slant * 40 / 256 + out / 16.0;
        if (out < reach - slack) {
          EXPECT_GE(behind.inverse[i], 0);
        }
        if (out > reach + slack) {
          EXPECT_EQ(behind.inverse[i], -1);
        }
        if (behind.inverse[i] < 0) {
          ++hidden;
          continue;
        }
        ++found;
        // Sources lie up to half a pixel off their ways.
        EXPECT_NEAR(behind.coc_quanta[i], p.plane(x, y), slant + 2);
        EXPECT_NEAR(behind.inverse[i], 1 - p.plane(x, y) / 8000, (slant + 2) / 8000);
        EXPECT_NEAR(behind.channels[0][i], 0.25f, 1e-6);
        EXPECT_NEAR(behind.channels[2][i], 0.75f, 1e-6);
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(hidden, 100);
}

/// A dim plane with a lamp at the corners and in the middle: everywhere a lamp is found, alike.
TEST(HighlightsOracle, KeepsOfALampWhatIsAroundIt) {
  constexpr int width = 23, height = 19;
  const std::size_t count = size(width) * size(height);
  const std::size_t lamps[] = {0, size(width) - 1, count / 2, count - size(width), count - 1};
  Frame f{width, height, Quanta(std::vector<std::int32_t>(count, 640)), Plane(count, 3.0f),
          Planes{Plane(count, 0.25f)}};
  Plane colour(count, 0.25f);
  for (const std::size_t lamp : lamps) colour[lamp] = 50;
  f.channels = Planes{colour};
  f.coverage = Words(std::vector<std::uint32_t>(count, DEFRAY_WHOLE));
  for (Backend* backend : device_and_twins()) {
    const Values<float> kept = backend->highlights(f, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_lamp = std::find(std::begin(lamps), std::end(lamps), i) != std::end(lamps);
      EXPECT_FLOAT_EQ(kept[i], is_lamp ? 0.25f / 50 : 1.0f) << i;
    }
  }
}

/// No cliff: what a lamp keeps goes from all to its surroundings' light as it grows brighter.
TEST(HighlightsOracle, BrighterLampsKeepLessAndLessAndNeverAStepLess) {
  constexpr int width = 21, height = 21;
  const std::size_t count = size(width) * size(height);
  Frame f{width, height, Quanta(std::vector<std::int32_t>(count, 640)), Plane(count, 3.0f),
          Planes{}};
  f.coverage = Words(std::vector<std::uint32_t>(count, DEFRAY_WHOLE));
  const auto kept_at = [&](Backend& backend, float ratio) {
    Plane colour(count, 0.25f);
    colour[count / 2] = 0.25f * ratio;
    f.channels = Planes{colour};
    return backend.highlights(f, 1)[count / 2];
  };
  for (Backend* backend : device_and_twins()) {
    float before = 1;
    for (int tenth = 60; tenth <= 200; ++tenth) {
      const float ratio = 0.1f * static_cast<float>(tenth), kept = kept_at(*backend, ratio);
      if (ratio <= DEFRAY_HIGHLIGHT) EXPECT_EQ(kept, 1) << ratio;
      if (ratio >= DEFRAY_HIGHLIGHT_WHOLE) EXPECT_NEAR(kept, 1 / ratio, 1e-6) << ratio;
      EXPECT_LE(kept, before) << ratio;
      EXPECT_GE(kept, before - 0.02f) << ratio;
      before = kept;
    }
  }
}

}  // namespace
}  // namespace defray::test::stage_oracles_test
