// Which parts of the lens see a lamp: against where its light passes what is in front.
#include <cmath>
#include <optional>

#include "chain/steps/highlights.h"
#include "device/device_backend.h"
#include "reference/reference.h"
#include "support.h"

namespace defray::test::light_maps_test {
namespace {

constexpr int side = 201, middle = 100, px = 256;

/// A lamp in the middle of a wall with CoC radius 40 px, and something in front where is(x, y).
template <typename Is>
Frame frame_with(std::int32_t front_px, const Is& is) {
  Frame f{side, side, {}, {}, {}};
  std::vector<std::int32_t> coc;
  Plane depth;
  for (int i = 0; i < side * side; ++i) {
    const bool is_front = is(i % side, i / side);
    coc.push_back(is_front ? front_px * px : 40 * px);
    depth.push_back(is_front ? 2.0f : 9.0f);
  }
  f.coc_quanta = coc;
  f.depth = depth;
  f.channels = {Plane(f.pixels(), 1.0f)};
  return f;
}

LightSources lamp() {
  LightSources lights;
  lights.where = {{middle, middle, 40 * px, 1 + DEFRAY_LIGHT_ROW}};
  lights.excess = {{1, 1, 1, 1}};
  lights.maps = {{0, 64, -40 * px, 0}};
  lights.map_entries = 64 * 64;
  lights.table = {1};
  sort_into_tiles(lights, side, side);
  return lights;
}

/// Checks the map's entries by whether light through (u, v) passes; `near` says where that is
/// close.
template <typename Passes>
void expect_map(const Frame& f, const Passes& passes) {
  const std::vector<std::uint8_t> map = reference::light_maps(lamp(), f);
  auto& backend = dynamic_cast<DeviceBackend&>(device());
  EXPECT_EQ(backend.light_maps(f, lamp()), map);
  int passed = 0, hidden = 0;
  for (int i = 0; i < 64 * 64; ++i) {
    const double u = (i % 64 * 2 - 63) / 64.0, v = (i / 64 * 2 - 63) / 64.0;
    if (u * u + v * v > 1) continue;
    const auto is = passes(u, v);
    if (!is) continue;
    ++(*is ? passed : hidden);
    EXPECT_EQ(int{map[static_cast<std::size_t>(i)]}, *is ? 255 : 0) << u << " " << v;
  }
  EXPECT_GT(passed, 300);
  EXPECT_GT(hidden, 300);
}

TEST(LightMaps, AnEdgeHidesWhereLightPassesItsDepth) {
  // From x = 108 on, at 40 - front px of CoC from the lamp.
  for (const int front : {20, 4, -20}) {
    const Frame f = frame_with(front, [](int x, int) { return x >= 108; });
    expect_map(f, [&](double u, double) -> std::optional<bool> {
      const double x = middle + (40 - front) * u;
      if (std::fabs(x - 107.5) < 1) return {};
      return x < 107.5;
    });
  }
}

TEST(LightMaps, APostHidesAStripOfTheLens) {
  const Frame f = frame_with(-10, [](int x, int) { return x >= 105 && x < 125; });
  expect_map(f, [&](double u, double) -> std::optional<bool> {
    const double x = middle + 50 * u;
    if (std::fabs(x - 104.5) < 1 || std::fabs(x - 124.5) < 1) return {};
    return x < 104.5 || x > 124.5;
  });
}

TEST(LightMaps, WhatIsInFocusHidesInItsOwnPixelsAlone) {
  const Frame f = frame_with(0, [](int x, int) { return x >= 108; });
  for (const std::uint8_t seen : reference::light_maps(lamp(), f)) EXPECT_EQ(seen, 255);
}

TEST(LightMaps, SharesOfPixelsHideAsMuch) {
  Frame f = frame_with(10, [](int x, int) { return x >= 108; });
  f.coverage = Words(f.surfaces(), DEFRAY_WHOLE / 4);
  const std::vector<std::uint8_t> map = reference::light_maps(lamp(), f);
  EXPECT_EQ(int{map[32 * 64 + 60]}, 191);
  EXPECT_EQ(int{map[32 * 64 + 3]}, 255);
}

}  // namespace
}  // namespace defray::test::light_maps_test
