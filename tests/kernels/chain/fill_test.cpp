// Kernel fill: what lies behind.
#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers.h"
#include "stages_support.h"

namespace defray::test::fill_test {
namespace {

TEST(Fill, BehindABarThePlaneGoesOn) {
  Canvas f(60, 40);
  f.each([&](int x, int y) { f.paint(x, y, 0.25f, 0.5f, 0.75f); });
  for (int y = 0; y < f.height; ++y) {
    for (int x = 27; x < 33; ++x) f.paint(x, y, 1, 0, 0);
  }
  f.add_bar(27, 33);
  const Frame behind = f.filled();
  for (int y = 0; y < f.height; ++y) {
    for (int x = 28; x < 32; ++x) {  // the bar's pure pixels
      const std::size_t i = f.at(x, y);
      EXPECT_EQ(behind.coc_quanta[i], 1536);
      EXPECT_NEAR(behind.inverse[i], 0.2f, 0.2f * 0x1p-20f);
      EXPECT_NEAR(behind.channels[0][i], 0.25f, 0x1p-22f);
      EXPECT_NEAR(behind.channels[1][i], 0.5f, 0x1p-21f);
      EXPECT_NEAR(behind.channels[2][i], 0.75f, 0x1p-20f);
      EXPECT_NEAR(behind.channels[3][i], 1.0f, 0x1p-20f);
    }
  }
}

/// Ways in 16 directions end in whole pixels: a source lies up to half a pixel beside the line
/// along which it is continued, where a plane without slant would be off by all the way back.
TEST(Fill, BehindAnEdgeASlantedPlaneKeepsItsSlant) {
  for (const double slant : {12.0, -40.0}) {
    Canvas f(80, 60);
    f.each([&](int x, int y) {
      f.coc[f.at(x, y)] = static_cast<std::int32_t>(3000 + slant * (x - 40));
      f.inverse[f.at(x, y)] = static_cast<float>(0.2 - slant * 1e-4 * (x - 40));
    });
    const std::vector<std::int32_t> plane = f.coc;
    const Plane plane_inverse = f.inverse;
    f.add_bar(36, 80);
    const Frame behind = f.filled();
    for (int y = 25; y < 35; ++y) {
      for (int x = 37; x < 43; ++x) {
        const std::size_t i = f.at(x, y);
        EXPECT_NEAR(behind.coc_quanta[i], plane[i], std::fabs(slant) * 0.5) << x;
        EXPECT_NEAR(behind.inverse[i], plane_inverse[i], std::fabs(slant) * 0.5e-4);
      }
    }
  }
}

/// Directions have five numbers each, twin and kernel their own: what they differ by shows far
/// away.
TEST(Fill, EqualsItsTwinFarAway) {
  if (is_slow_device()) GTEST_SKIP() << "150 thousand pixels";
  Canvas f(600, 260);
  f.coc.assign(f.count(), 256 * 500);
  f.each([&](int x, int y) {
    const auto shade = static_cast<float>((x * 7 + y * 13) % 101);
    f.paint(x, y, shade, 0.5f * shade, 1);
  });
  f.add_bar(40, 600);
  const Words mixed = f.mixed();
  for (const int directions : {8, DEFRAY_FILL_DIRECTIONS}) {
    const Frame ours = device().fill(f.view(), mixed, directions);
    const Frame twin = twins().fill(f.view(), mixed, directions);
    expect_same_bits(ours.channels[0], twin.channels[0]);
  }
}

/// Just no jump from pixel to pixel: where ways pass over what they need not look at, nothing
/// begins.
TEST(Fill, EqualsItsTwinOnSlopes) {
  Canvas f(150, 40);
  f.each([&](int x, int y) {
    f.coc[f.at(x, y)] = 250 * x;
    f.paint(x, y, static_cast<float>((x * 7 + y * 13) % 101), 1, 0.5f);
  });
  f.add_bar(20, 24);
  const Words mixed = f.mixed();
  const Frame ours = device().fill(f.view(), mixed, 8), twin = twins().fill(f.view(), mixed, 8);
  expect_same_bits(ours.channels[0], twin.channels[0]);
  expect_same_bits(ours.inverse, twin.inverse);
}

/// Rows alone: one way left and one right, both exact.
TEST(Fill, BehindABarInARowTheSlantIsExact) {
  Canvas f(81, 1);
  f.each([&](int x, int y) {
    f.coc[f.at(x, y)] = 1536 + 16 * (x - 40);
    f.inverse[f.at(x, y)] = 0.2f - (x - 40) / 1024.0f;
  });
  const std::vector<std::int32_t> plane = f.coc;
  const Plane plane_inverse = f.inverse;
  f.add_bar(37, 44);
  const Frame behind = f.filled();
  for (int x = 37; x < 44; ++x) {
    EXPECT_EQ(behind.coc_quanta[f.at(x, 0)], plane[f.at(x, 0)]) << x;
    EXPECT_NEAR(behind.inverse[f.at(x, 0)], plane_inverse[f.at(x, 0)], 0x1p-22f) << x;
  }
}

TEST(Fill, ReachesAsFarAsTheLensSeesPastTheEdgeAndNoFurther) {
  Canvas f(200, 3);
  f.add_bar(50, 200);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) f.coc[f.at(x, y)] = 20000;  // so far that ways go on past the plane
  }
  const Frame behind = f.filled();
  for (int x = 50; x < 200; ++x) {
    // 6 px of CoC, 2 more; the plane's last pixel is 49.
    const bool is_plane = behind.inverse[f.at(x, 1)] >= 0 && behind.coc_quanta[f.at(x, 1)] < 20000;
    EXPECT_EQ(is_plane, x - 49 <= 6 + 2) << x;
    EXPECT_EQ(behind.coc_quanta[f.at(x, 1)] == 1536, is_plane) << x;
    // Of what is farther, the last pixel is 4; steps on the way are up to 1 + a 16th of it.
    const int distance = x - 4, reach = 20000 / 256 + 2;
    if (distance > reach) {
      EXPECT_EQ(behind.inverse[f.at(x, 1)], -1.0f) << x;
    } else if (distance + distance / 16 <= reach) {
      EXPECT_GE(behind.inverse[f.at(x, 1)], 0.0f) << x;
    }
  }
}

TEST(Fill, NothingLiesBehindTheFarthestOrBesideItself) {
  Canvas f(60, 20);
  f.add_bar(20, 26);
  const Frame behind = f.filled();
  // Mixed pixels of the plane have the bar in front of them; pure ones nothing.
  f.each([&](int x, int y) {
    if (x < 19 || x > 26) {
      EXPECT_EQ(behind.inverse[f.at(x, y)], -1.0f) << x << " " << y;
    }
  });
  Canvas slope(60, 20);  // steep, but one surface
  for (const int rise : {150, 300, 500}) {
    slope.each([&](int x, int y) { slope.coc[slope.at(x, y)] = rise * x; });
    for (const float i : slope.filled().inverse) EXPECT_EQ(i, -1.0f) << rise;
  }
}

/// The lens sees all of what rises by more than a pixel a pixel; only from the bar on, or from
/// pixels beside it, is it behind something.
TEST(Fill, WhatIsHardlyFartherThanItsBlurDoesNotHideTheWallBeyond) {
  // A post before a rail that is blurred by 3 px less: behind where they cross the rail, which
  // shows for 3 px at most, or the wall. At 300 px of blur the wall, at 30 px the rail.
  for (const int blur_px : {30, 300}) {
    Canvas f(60, 40);
    std::fill(f.coc.begin(), f.coc.end(), 0);
    const auto add = [&](int x0, int x1, int y0, int y1, int coc, float inverse) {
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) f.coc[f.at(x, y)] = coc, f.inverse[f.at(x, y)] = inverse;
      }
    };
    const int rail_coc = (3 - blur_px) * 256;
    add(0, 60, 16, 24, rail_coc, 1.6f);
    add(26, 34, 0, 40, -blur_px * 256, 1.7f);
    const Frame behind = f.filled();
    EXPECT_EQ(behind.coc_quanta[f.at(27, 20)], blur_px == 30 ? rail_coc : 0) << blur_px;
  }
}

TEST(Fill, ASteepSlopeLiesBehindABarAlone) {
  Canvas f(120, 20);
  f.each([&](int x, int y) { f.coc[f.at(x, y)] = 300 * x; });
  f.add_bar(60, 66);
  const Frame behind = f.filled();
  f.each([&](int x, int y) {
    const bool is_behind = behind.inverse[f.at(x, y)] >= 0;
    if (x >= 60 && x < 66) EXPECT_TRUE(is_behind) << x;
    if (x > 66) EXPECT_FALSE(is_behind) << x;
  });
}

TEST(Fill, ANearerSurfaceNeverFills) {
  Canvas f(60, 20);
  for (std::int32_t& c : f.coc) c = 0;
  f.each([&](int x, int y) {
    if (x >= 20 && x < 40) f.coc[f.at(x, y)] = -1536;
    f.paint(x, y, f.coc[f.at(x, y)] < 0 ? 1 : 0, 0, 0);
  });
  const Frame behind = f.filled();
  f.each([&](int x, int y) {
    const std::size_t i = f.at(x, y);
    if (behind.inverse[i] < 0) return;
    EXPECT_EQ(behind.coc_quanta[i], 0);
    EXPECT_EQ(behind.channels[0][i], 0.0f);
    EXPECT_TRUE(x >= 19 && x <= 40) << x;
  });
  EXPECT_GE(behind.inverse[f.at(20, 10)], 0.0f);
}

TEST(Fill, ALoneHighlightDoesNotSmear) {
  for (const float highlight : {1e4f, std::numeric_limits<float>::max(), infinite, nan}) {
    Canvas f(60, 40);
    f.each([&](int x, int y) { f.paint(x, y, 0.5f, 0.5f, 0.5f); });
    f.add_bar(27, 33);
    f.paint(34, 20, highlight, highlight, highlight);
    const Frame behind = f.filled();
    for (int y = 0; y < f.height; ++y) {
      for (int x = 28; x < 32; ++x) EXPECT_NEAR(behind.channels[0][f.at(x, y)], 0.5f, 0x1p-20f);
    }
  }
}

TEST(Fill, ASmallHighlightIsNotAllThatLiesBehind) {
  // From the middle of a wide bar only the way to the left is short enough.
  Canvas f(80, 3);
  f.each([&](int x, int y) { f.paint(x, y, 0.5f, 0.5f, 0.5f); });
  f.add_bar(30, 80);
  for (int x = 26; x < 29; ++x) f.paint(x, 1, 50, 50, 50);
  const Frame behind = f.filled();
  ASSERT_GE(behind.inverse[f.at(34, 1)], 0);
  EXPECT_NEAR(behind.channels[0][f.at(34, 1)], 0.5f, 0x1p-20f);
}

TEST(Fill, StripesGoOnInTheirDirection) {
  const auto stripe = [](int n) { return n / 4 % 2 ? 0.8f : 0.1f; };
  for (const bool along_rows : {true, false}) {
    Canvas f(64, 64);
    f.each([&](int x, int y) {
      const float v = stripe(along_rows ? y : x + y);
      f.paint(x, y, v, v, v);
    });
    f.add_bar(28, 36);
    const Frame behind = f.filled();
    double error = 0, plain = 0;
    for (int y = 20; y < 44; ++y) {
      for (int x = 29; x < 35; ++x) {
        const float expected = stripe(along_rows ? y : x + y);
        error += std::fabs(behind.channels[0][f.at(x, y)] - expected);
        plain += std::fabs(0.45 - expected);
      }
    }
    EXPECT_LT(error, (along_rows ? 0.35 : 0.7) * plain);
  }
}

/// Behind a bar across a slanting edge between two surfaces that edge goes on from one side to the
/// other, through its middle; by the surface of the nearest pixel it ended in one step there.
/// A dark line of 3 px that slants across a bar of 10: behind it most ways meet what is beside the
/// line, but only along it is found what goes on.
TEST(Fill, ALineGoesOnBehindABar) {
  for (const int slope : {0, 1}) {
    Canvas f(70, 70);
    f.coc.assign(f.count(), 256 * 30);
    const auto beside = [&](int x, int y) { return y - 35 - slope * (x - 35); };
    f.each([&](int x, int y) {
      const float v = std::abs(beside(x, y)) <= 1 ? 0.1f : 0.8f;
      f.paint(x, y, v, v, v);
    });
    f.add_bar(30, 40);
    const Frame behind = f.filled();
    for (int x = 31; x < 39; ++x) {
      for (int y = 25; y < 45; ++y) {
        const float v = behind.channels[0][f.at(x, y)];
        if (beside(x, y) == 0) EXPECT_LT(v, 0.25f) << slope << ": " << x << ", " << y;
        if (std::abs(beside(x, y)) == 4) EXPECT_GT(v, 0.7f) << slope << ": " << x << ", " << y;
      }
    }
  }
}

TEST(Fill, ASilhouetteGoesOnBehindABar) {
  for (const double slope : {1.0, 0.5, -1.0}) {
    Canvas f(90, 60);
    const auto edge = [&](int y) { return 45 + slope * (y - 30.5); };
    f.each([&](int x, int y) { f.coc[f.at(x, y)] = x < edge(y) ? 0 : 1536; });
    for (int y = 25; y < 37; ++y) {
      for (int x = 0; x < f.width; ++x) f.coc[f.at(x, y)] = -4096, f.inverse[f.at(x, y)] = 0.9f;
    }
    const Frame behind = f.filled();
    for (int y = 26; y < 36; ++y) {
      int first = 0;  // behind the edge
      while (behind.coc_quanta[f.at(first, y)] < 768) ++first;
      const bool is_middle = y == 30 || y == 31;
      EXPECT_NEAR(first, edge(y), is_middle ? 3 : 5) << slope << " in row " << y;
    }
  }
}

/// Something to fill in one tile alone: a band that took another's flags would leave it empty.
TEST(Fill, BandsTakeTheFlagsOfTheirOwnTiles) {
  Canvas f(3 * DEFRAY_FILL_TILE, 400);
  for (int y = 330; y < 334; ++y) f.coc[f.at(20, y)] = 0, f.inverse[f.at(20, y)] = 0.5f;
  const Frame whole = f.filled();
  const InBands in_bands(session(), 1);
  const Frame banded = f.filled();
  EXPECT_GT(whole.inverse[f.at(20, 331)], 0);
  expect_same_bits(whole.inverse, banded.inverse);
}

}  // namespace
}  // namespace defray::test::fill_test
