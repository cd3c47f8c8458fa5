// Depth conventions.
#include "lens/depth.h"

#include <cmath>
#include <limits>

#include "support.h"

namespace defray::test::depth_test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
const Window window{0, 0, 5, 1};

Plane converted(Plane depth, const DepthSettings& settings, DepthReport* report = nullptr,
                const Window& data = window, const Window& display = window) {
  const DepthReport r = convert_depth(depth, settings, data, display, 100, "z.exr");
  if (report) *report = r;
  return depth;
}

TEST(Depth, RecognisesBackgrounds) {
  DepthReport report;
  const Plane z = converted({2, 1e10f, 65504, 0, -1}, {}, &report);
  EXPECT_EQ(z, (Plane{2, inf, inf, inf, inf}));
  EXPECT_EQ(report.background, 4u);
  EXPECT_EQ(report.nearest_units, 2);
  EXPECT_EQ(report.farthest_units, 2);
  EXPECT_EQ(converted({inf, 3, 4, 5, 6}, {})[0], inf);
}

TEST(Depth, CountsNan) {
  DepthReport report;
  converted({NAN, 3, 4, 5, 6}, {}, &report);
  EXPECT_EQ(report.not_a_number, 1u);
  EXPECT_EQ(report.background, 1u);
}

TEST(Depth, AnExplicitBackgroundIsTheOnlyOne) {
  DepthSettings settings;
  settings.background = 7;
  EXPECT_EQ(converted({2, 7, 65504, 3, 4}, settings), (Plane{2, inf, 65504, 3, 4}));
  expect_error(ErrorKind::input, {"z.exr", "depth 0", "(3, 0)", "background"}, [&] {
    converted({2, 7, 3, 0, 4}, settings);
  });
  expect_error(ErrorKind::input, {"depth -1"}, [&] { converted({2, 7, 3, -1, 4}, settings); });
}

TEST(Depth, NothingButBackground) {
  DepthReport report;
  converted({0, 0, 0, 0, 0}, {}, &report);
  EXPECT_EQ(report.background, 5u);
  EXPECT_EQ(report.nearest_units, 0);
}

TEST(Depth, Inverse) {
  DepthSettings settings;
  settings.kind = DepthKind::inverse;
  EXPECT_EQ(converted({0.5f, 2, 0, 4, 1}, settings), (Plane{2, 0.5f, inf, 0.25f, 1}));
}

TEST(Depth, WhatIsNoDepthIsNotBehindTheCamera) {
  for (const DepthKind kind : {DepthKind::normalized, DepthKind::zbuffer}) {
    DepthSettings settings;
    settings.kind = kind;
    settings.near_units = 1;
    settings.far_units = 9;
    DepthReport report;
    converted({0.5f, 0.25f, -0.05f, 0.75f, 0.6f}, settings, &report);
    EXPECT_EQ(report.behind_camera, 0u);
  }
  DepthReport report;
  converted({0.5f, 2, -1, 4, 1}, {}, &report);
  EXPECT_EQ(report.behind_camera, 1u);
  DepthSettings inverse;
  inverse.kind = DepthKind::inverse;
  converted({0.5f, 2, -1, 0, 1}, inverse, &report);
  EXPECT_EQ(report.behind_camera, 1u);
}

TEST(Depth, Normalized) {
  DepthSettings settings;
  settings.kind = DepthKind::normalized;
  settings.near_units = 2;
  settings.far_units = 10;
  EXPECT_EQ(converted({0, 0.25f, 1, 0.5f, inf}, settings), (Plane{2, 4, 10, 6, inf}));
  settings.invert = true;
  EXPECT_EQ(converted({0, 0.25f, 1, 0.5f, 0.5f}, settings), (Plane{10, 8, 2, 6, 6}));
}

TEST(Depth, DistanceAlongTheRayKnowsThePixelsPlaceInTheDisplayWindow) {
  DepthSettings settings;
  settings.kind = DepthKind::distance;
  // A plane at z = 3 seen as distances, in a data window away from the display window's corner.
  const Window data{70, 10, 5, 1}, display{0, 0, 100, 60};
  Plane distance;
  for (int x = 70; x < 75; ++x) {
    distance.push_back(static_cast<float>(3 * std::hypot(100, x + 0.5 - 50, 10.5 - 30) / 100));
  }
  for (const float z : converted(distance, settings, nullptr, data, display)) {
    EXPECT_NEAR(z, 3, 1e-6);
  }
}

TEST(Depth, DistanceKnowsWhereTheDisplayWindowBegins) {
  DepthSettings settings;
  settings.kind = DepthKind::distance;
  const Window data{35, -22, 4, 3}, display{30, -20, 21, 11};
  Plane distance;
  for (int y = -22; y < -19; ++y) {
    for (int x = 35; x < 39; ++x) {
      const double right = x + 0.5 - 40.5, down = y + 0.5 + 14.5;
      distance.push_back(static_cast<float>(3 * std::hypot(100, right, down) / 100));
    }
  }
  for (const float z : converted(distance, settings, nullptr, data, display)) {
    EXPECT_NEAR(z, 3, 1e-6);
  }
}

TEST(Depth, BackgroundsBeginWhereTheyAreSaidTo) {
  const auto before = [](float v) { return std::nextafter(v, 0.0f); };
  EXPECT_EQ(converted({1e9f, before(1e9f), before(65504), 65505, 1e-40f}, {}),
            (Plane{inf, before(1e9f), before(65504), 65505, 1e-40f}));
  DepthSettings inverse;
  inverse.kind = DepthKind::inverse;
  DepthReport report;
  // 1/z of a denormal is farther than floats go.
  EXPECT_EQ(converted({1e-40f, -1, 1e-30f, 4, 2}, inverse, &report),
            (Plane{inf, inf, 1e30f, 0.25f, 0.5f}));
  EXPECT_EQ(report.background, 2u);
  EXPECT_EQ(report.nearest_units, 0.25);
  EXPECT_NEAR(report.farthest_units, 1e30, 1e24);
}

TEST(Depth, NormalizedOutsideItsRangeIsCounted) {
  DepthSettings settings;
  settings.kind = DepthKind::normalized;
  settings.near_units = 2;
  settings.far_units = 10;
  DepthReport report;
  converted({0, 1, -0.125f, 1.125f, inf}, settings, &report);
  EXPECT_EQ(report.outside_range, 2u);
  EXPECT_EQ(report.background, 1u);
  EXPECT_EQ(report.nearest_units, 1);
  EXPECT_EQ(report.farthest_units, 11);
  DepthReport planar;
  converted({0.5f, 2, 3, 4, 5}, {}, &planar);
  EXPECT_EQ(planar.outside_range, 0u);
}

TEST(Depth, ARangeMayBeginAtTheCamera) {
  DepthSettings settings;
  settings.kind = DepthKind::normalized;
  settings.far_units = 8;
  validate(settings);
  DepthReport report;
  EXPECT_EQ(converted({0, 0.25f, 1, 0.5f, inf}, settings, &report),
            (Plane{std::numeric_limits<float>::min(), 2, 8, 4, inf}));
  EXPECT_GT(report.nearest_units, 0);
}

TEST(Depth, NegativeZ) {
  DepthSettings settings;
  settings.kind = DepthKind::negative_z;
  DepthReport report;
  EXPECT_EQ(converted({-2, -65504, 0, -1e10f, -3}, settings, &report),
            (Plane{2, inf, inf, inf, 3}));
  EXPECT_EQ(report.behind_camera, 0u);
  EXPECT_EQ(converted({-2, 4, -5, -6, 1e10f}, settings, &report), (Plane{2, inf, 5, 6, inf}));
  EXPECT_EQ(report.behind_camera, 1u);
}

/// Unity's LinearEyeDepth with its _ZBufferParams, whose depth 1 is far, or near where reversed.
TEST(Depth, ABufferOfAGpuIsLinearInOneOverDepth) {
  DepthSettings settings;
  settings.kind = DepthKind::zbuffer;
  settings.near_units = 0.5;
  settings.far_units = 100;
  const DepthSettings forward = settings;
  const Plane stored{0, 0.25f, 0.5f, 0.75f, 1};
  for (const bool reversed : {false, true}) {
    settings.invert = reversed;
    const double n = 0.5, f = 100;
    const double x = reversed ? -1 + f / n : 1 - f / n, y = reversed ? 1 : f / n;
    const Plane z = converted(stored, settings);
    for (std::size_t i = 0; i < z.size(); ++i) {
      EXPECT_NEAR(z[i], 1 / (x / f * static_cast<double>(stored[i]) + y / f), 1e-5) << i;
    }
  }
  // Unreal's: reversed, its far end at infinity, near / depth.
  settings.far_units = HUGE_VAL;
  validate(settings);
  EXPECT_EQ(converted({0, 0.25f, 0.5f, 0.125f, 1}, settings), (Plane{inf, 2, 1, 4, 0.5f}));
  DepthReport report;
  converted({0, 0.25f, 1.5f, 0.125f, 1}, settings, &report);
  EXPECT_EQ(report.outside_range, 1u);
  expect_error(ErrorKind::input,
               {"z.exr: stored depth 6 at pixel (2, 0) lies outside 0 to 1", "depth.kind is z"},
               [&] {
                 converted({0, 0.25f, 6, 0.125f, 1}, forward);
               });
  settings.near_units = 0;
  expect_error(ErrorKind::usage, {"zbuffer needs 0 < near_units < far_units", "inf is allowed"},
               [&] { validate(settings); });
}

TEST(Depth, WrongSignsAreCountedAndRefusedWhereTheyAreMost) {
  DepthReport report;
  converted({2, 3, 4, -5, -6}, {}, &report);
  EXPECT_EQ(report.behind_camera, 2u);
  converted({0, 0, 1e10f, -0.0f, inf}, {}, &report);
  EXPECT_EQ(report.behind_camera, 0u);
  expect_error(ErrorKind::input,
               {"z.exr: depth is negative in 3 px (60.0 % of all), positive in 2 px only",
                "camera-space -z", "depth.kind negative-z"},
               [] {
                 converted({2, 3, -4, -5, -6}, {});
               });
  DepthSettings turned;
  turned.kind = DepthKind::negative_z;
  expect_error(ErrorKind::input, {"positive in 5 px (100.0 % of all), negative in 0 px only"}, [&] {
    converted({2, 3, 4, 5, 6}, turned);
  });
  DepthSettings inverse;
  inverse.kind = DepthKind::inverse;
  expect_error(ErrorKind::input,
               {"negative in 3 px (60.0 % of all), positive in 2 px only: 1/z is above 0"}, [&] {
                 converted({2, 3, -4, -5, -6}, inverse);
               });
  DepthSettings background;
  background.background = -1;
  EXPECT_EQ(converted({-1, -1, -1, -1, 3}, background, &report)[4], 3);
  EXPECT_EQ(report.behind_camera, 0u);
}

TEST(Depth, SettingsThatContradictEachOther) {
  DepthSettings settings;
  settings.invert = true;
  expect_error(ErrorKind::usage, {"invert", "normalized"}, [&] { validate(settings); });
  settings = {};
  settings.near_units = 1;
  expect_error(ErrorKind::usage, {"near_units", "normalized"}, [&] { validate(settings); });
  settings.kind = DepthKind::normalized;
  for (const auto& [near, far] : {std::pair{1.0, 0.0}, {-1.0, 3.0}, {2.0, 2.0}, {1.0, HUGE_VAL}}) {
    settings.near_units = near;
    settings.far_units = far;
    expect_error(ErrorKind::usage,
                 {"near_units < far_units", fmt::format("found near {} far {}", near, far)},
                 [&] { validate(settings); });
  }
  settings = {};
  settings.far_units = 3;
  expect_error(ErrorKind::usage, {"far_units", "normalized"}, [&] { validate(settings); });
}

}  // namespace
}  // namespace defray::test::depth_test
