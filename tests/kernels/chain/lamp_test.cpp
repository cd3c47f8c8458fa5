// Lamps through the whole chain: all of their light, at their place, whatever they lie on.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/method.h"
#include "stages_support.h"

namespace defray::test::lamp_test {
namespace {

constexpr int width = 96, height = 64;

/// What a lamp adds to a picture.
struct Spot {
  double light = 0, x = 0, y = 0;
};

/// A wall, and a second surface on its right half; `mixed` lies between, as an antialiased
/// render has it.
struct Wall {
  std::int32_t left, right;
  float mixed;  ///< Share of the right surface in column 48.
};

Frame frame_of(const Wall& wall, int lamp_x, float lamp) {
  Plane depth(size(width) * size(height)), colour(depth.size());
  std::vector<std::int32_t> coc(depth.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = size(y) * size(width) + size(x);
      const bool is_right = x >= 48;
      coc[i] = is_right ? wall.right : wall.left;
      depth[i] = coc[i] < 0 ? 1.0f : coc[i] == 0 ? 2.0f : 5.0f;
      const float own = is_right ? 0.8f : 0.2f;
      colour[i] = x == 48 ? 0.2f + 0.6f * wall.mixed : own;
    }
  }
  colour[size(height) / 2 * size(width) + size(lamp_x)] += lamp;
  return {width, height, coc, depth, {colour}};
}

Spot spot(const Wall& wall, int lamp_x, Backend& on, const Aperture& aperture = {}) {
  MethodSettings settings;
  settings.chain = ChainSettings{};
  settings.chain->aperture = aperture;
  const float lamp = 3000;
  const Planes with = apply_method(frame_of(wall, lamp_x, lamp), settings, on).colour;
  const Planes without = apply_method(frame_of(wall, lamp_x, 0), settings, on).colour;
  Spot s;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = size(y) * size(width) + size(x);
      const double more = (double{with[0][i]} - without[0][i]) / lamp;
      s.light += more;
      s.x += more * (x - lamp_x);
      s.y += more * (y - height / 2);
    }
  }
  s.x /= s.light;
  s.y /= s.light;
  return s;
}

TEST(Lamp, OnAPlainWallKeepsItsLightAndPlace) {
  for (const std::int32_t coc : {0, 200, 1000, 1536, 3000, -1000, -2500}) {
    const Spot s = spot({coc, coc, 1}, 30, coc == 1536 ? twins() : device());
    EXPECT_NEAR(s.light, 1, 0.01) << coc;
    EXPECT_NEAR(s.x, 0, 0.05) << coc;
    EXPECT_NEAR(s.y, 0, 0.05) << coc;
  }
}

TEST(Lamp, OnAMixedEdgeKeepsItsLight) {
  for (const float mixed : {0.25f, 0.5f, 0.75f}) {
    for (const Wall& wall : {Wall{0, -1536, mixed}, Wall{0, -2500, mixed}, Wall{1536, 0, mixed}}) {
      const Spot s = spot(wall, 48, device());
      SCOPED_TRACE(testing::Message() << wall.left << " " << wall.right << " " << mixed);
      EXPECT_NEAR(s.light, 1, 0.1);
    }
  }
}

TEST(Lamp, NearTheEdgeOfANearSurfaceLosesOnlyWhatItHides) {
  // In focus in front of it: what reaches beyond column 48 is hidden.
  const Spot free = spot({1536, 0, 1}, 30, device()), half = spot({1536, 0, 1}, 47, device());
  EXPECT_NEAR(free.light, 1, 0.01);
  EXPECT_NEAR(half.light, 0.55, 0.06);
  EXPECT_LT(half.x, -2);
}

/// By how much neighbours above each other differ in the middle of a lamp's disc, as a share of its
/// brightest pixel: RMS.
double roughness(const Plane& colour, int lamp_x, int radius) {
  double sum = 0, count = 0, brightest = 0;
  for (int y = -radius; y < radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const std::size_t i = size(height / 2 + y) * size(width) + size(lamp_x + x);
      brightest = std::max(brightest, double{colour[i]});
      sum += std::pow(double{colour[i + size(width)]} - colour[i], 2);
      ++count;
    }
  }
  return std::sqrt(sum / count) / brightest;
}

TEST(Lamp, BehindAnUprightEdgeItsDiscIsCutStraight) {
  // The edge's own pixels cover a part of what is behind them.
  const Frame f = frame_of({3000, 1500, 0.3f}, 46, 3000);
  MethodSettings settings;
  settings.chain = ChainSettings{};
  // 0.12; by the nearest cell alone 0.24.
  EXPECT_LT(roughness(apply_method(f, settings, device()).colour[0], 46, 7), 0.15);
}

}  // namespace
}  // namespace defray::test::lamp_test
