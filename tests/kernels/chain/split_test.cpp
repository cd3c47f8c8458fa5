// Kernel split: mixed pixels taken apart.
#include <cmath>
#include <limits>

#include "numbers.h"
#include "stages_support.h"

namespace defray::test::split_test {
namespace {

constexpr std::int32_t bar_coc = -512;

/// A bar over the plane whose edges cover their pixels by `share`; depth sees the bar or the plane.
Canvas bar_with_mixed_edges(float share, bool saw_front) {
  Canvas f(60, 20);
  const float front[3] = {2.0f, 1.5f, 0.1f}, behind[3] = {0.1f, 0.2f, 1.8f};
  f.add_bar(saw_front ? 24 : 25, saw_front ? 36 : 35, bar_coc);
  f.each([&](int x, int y) {
    const float a = x == 24 || x == 35 ? share : x > 24 && x < 35 ? 1.0f : 0.0f;
    f.paint(x, y, a * front[0] + (1 - a) * behind[0], a * front[1] + (1 - a) * behind[1],
            a * front[2] + (1 - a) * behind[2]);
  });
  return f;
}

TEST(Split, GivesTheCoverageBackAndBothSurfacesGiveTheColour) {
  for (const bool saw_front : {false, true}) {
    for (const float share : {0.3f, 0.5f, 0.6f, 0.74f}) {
      const Canvas f = bar_with_mixed_edges(share, saw_front);
      const auto [front, behind] = f.parted();
      for (int y = 0; y < f.height; ++y) {
        for (const int x : {24, 35}) {
          const std::size_t i = f.at(x, y);
          const double a = front.coverage[i] / 65536.0;
          EXPECT_NEAR(a, share, 1e-3);  // drawn to what is likely by 1e-3 |F|^2 / |F - B|^2
          EXPECT_EQ(front.coc_quanta[i], bar_coc);
          EXPECT_EQ(behind.coc_quanta[i], 1536);
          EXPECT_EQ(behind.coverage[i],
                    saw_front ? DEFRAY_WHOLE | DEFRAY_SYNTHESISED : DEFRAY_WHOLE);
          for (std::size_t c = 0; c < 4; ++c) {
            const double colour = f.channels[c][i];
            const double again = a * front.channels[c][i] + (1 - a) * behind.channels[c][i];
            EXPECT_NEAR(again, colour, 2 * 4 * 0x1p-23);
          }
          EXPECT_NEAR(front.channels[3][i], 1.0f, 1e-6f);
          EXPECT_NEAR(behind.channels[3][i], 1.0f, 1e-6f);
        }
      }
    }
  }
}

TEST(Split, WhereThreeSurfacesMeetTheOneThatWasSeenIsTakenApart) {
  // The bar, a strip beside it, and the plane, of which `fill` may say that it lies behind the bar.
  Canvas f(60, 20);
  f.add_bar(24, 36, bar_coc);
  f.each([&](int x, int y) {
    const bool is_strip = x >= 36 && x < 40;
    if (is_strip) f.coc[f.at(x, y)] = 512, f.inverse[f.at(x, y)] = 0.3f;
    if (x >= 24 && x < 36) f.paint(x, y, 0.8f, 0.2f, 0.1f);
    if (is_strip) f.paint(x, y, 0.75f, 0.7f, 0.6f);
  });
  Frame filled = f.filled();
  for (int y = 0; y < f.height; ++y) {
    filled.coc_quanta.edit()[f.at(36, y)] = 1536;
    for (auto& plane : filled.channels) plane.edit()[f.at(36, y)] = 0;
  }
  const auto [front, behind] = Parted(device().split(f.view(), f.mixed(), filled));
  for (int y = 0; y < f.height; ++y) {
    // The pixel is all strip: nothing to take apart, and nothing brighter than the strip.
    EXPECT_EQ(front.coverage[f.at(36, y)], DEFRAY_WHOLE);
    EXPECT_EQ(front.channels[1][f.at(36, y)], 0.7f);
  }
}

/// Such a bar in focus, before a plane of this CoC.
Canvas sharp_bar(float share, std::int32_t coc_behind) {
  Canvas f = bar_with_mixed_edges(share, true);
  std::fill(f.coc.begin(), f.coc.end(), coc_behind);
  f.add_bar(24, 36, 255);
  return f;
}

TEST(Split, AnEdgeInFocusIsTakenApartWhereTwoColoursExplainIt) {
  for (const float share : {0.5f, 0.8f}) {
    const Canvas f = sharp_bar(share, 1536);
    const Parted surfaces = f.parted();
    for (int y = 0; y < f.height; ++y) {
      for (const int x : {24, 35}) {
        const std::size_t i = f.at(x, y);
        EXPECT_NEAR(surfaces.front.coverage[i] / 65536.0, share, 1e-3);
        EXPECT_NEAR(surfaces.front.channels[0][i], 2.0f, 1e-2f);  // the bar's own colour
      }
    }
  }
}

TEST(Split, AnEdgeInFocusStaysAsItIsBeforeWhatIsNearlySharp) {
  const Canvas f = sharp_bar(0.5f, 511);
  const auto [front, behind] = f.parted();
  for (std::size_t c = 0; c < 3; ++c) expect_same_bits(front.channels[c], f.channels[c]);
  for (std::size_t i = 0; i < f.count(); ++i) EXPECT_EQ(front.coverage[i], DEFRAY_WHOLE);
}

TEST(Split, AnEdgeInFocusStaysAsItIsBeforeTexture) {
  Canvas f = sharp_bar(0.5f, 1536);
  const Plane noise = random_plane({60, 20}, 7);
  f.each([&](int x, int y) {
    const float v = noise[f.at(x, y)];
    if (x < 24 || x > 35) f.paint(x, y, 2 * v, 1.5f * v, v);
  });
  const auto [front, behind] = f.parted();
  for (int y = 0; y < f.height; ++y) EXPECT_GT(front.coverage[f.at(24, y)], 0.9 * DEFRAY_WHOLE);
}

TEST(Split, WithoutAStepNothingChanges) {
  Canvas f(31, 17);
  f.channels = {random_plane({31, 17}, 1), random_plane({31, 17}, 2)};
  f.channels[0][5] = -0.0f;
  f.channels[1][6] = nan;
  const auto [front, behind] = f.parted();
  for (std::size_t c = 0; c < 2; ++c) expect_same_bits(front.channels[c], f.channels[c]);
  expect_same_bits(front.depth, Plane(f.count(), 1 / f.inverse[0]));
  EXPECT_EQ(front.coc_quanta, f.coc);
  for (std::size_t i = 0; i < f.count(); ++i) {
    EXPECT_EQ(front.coverage[i], DEFRAY_WHOLE);
    EXPECT_FALSE(is_fragment(behind.depth[i]));
    EXPECT_EQ(behind.coverage[i], 0u);
  }
}

TEST(Split, AThinBrightThingIsTakenApart) {
  // A line one pixel wide at half a pixel's offset: half in one column, half in the next.
  Canvas f(40, 20);
  for (int y = 0; y < f.height; ++y) f.paint(19, y, 4, 4, 4);  // the part that depth saw
  for (int y = 0; y < f.height; ++y) f.paint(20, y, 1, 1, 1);  // a quarter of it
  f.add_bar(19, 20, bar_coc);
  const auto [front, behind] = f.parted();
  for (int y = 3; y < f.height - 3; ++y) {
    EXPECT_EQ(front.coverage[f.at(19, y)], DEFRAY_WHOLE);
    EXPECT_NEAR(front.coverage[f.at(20, y)] / 65536.0, 0.25, 2e-3);
    EXPECT_EQ(front.channels[0][f.at(20, y)], 4.0f);
    EXPECT_EQ(front.coc_quanta[f.at(20, y)], bar_coc);
    EXPECT_NEAR(behind.channels[0][f.at(20, y)], 0.0f, 1e-2f);
    EXPECT_EQ(behind.coc_quanta[f.at(20, y)], 1536);
  }
}

/// A bar from column 30 on, and a blade of half a pixel's width, `gap` px beside it and farther
/// than it: depth sees the blade in every second row.
Canvas blade_beside_a_bar(int gap) {
  Canvas f(50, 20);
  f.add_bar(30, 50, bar_coc);
  f.each([&](int x, int y) {
    if (x == 29 - gap) f.paint(x, y, 0.5f, 0.9f, 0.45f);
    if (x < 29 - gap || (x > 29 - gap && x < 30)) f.paint(x, y, 0.8f, 0.8f, 0.7f);
    if (x == 29 - gap && y % 2 == 1) f.coc[f.at(x, y)] = 512, f.inverse[f.at(x, y)] = 0.3f;
  });
  return f;
}

TEST(Split, AThinThingBesideAnotherEdgeIsTakenForItself) {
  // The bar reaches only into the pixels beside it; and what has the blade's colour is not the bar.
  for (const int gap : {0, 1, 2}) {
    const Canvas f = blade_beside_a_bar(gap);
    const auto [front, behind] = f.parted();
    for (int y = 3; y < f.height - 3; ++y) {
      EXPECT_EQ(front.coc_quanta[f.at(29 - gap, y)], 512) << gap << " " << y;
      EXPECT_GT(front.channels[1][f.at(29 - gap, y)], 0.8f) << gap << " " << y;
    }
  }
}

TEST(Split, WhatHasTheNearestColourIsNotTheThinThingBesideIt) {
  Canvas f = blade_beside_a_bar(1);
  const float bar = 0.1f, plane = 0.8f, half = (bar + plane) / 2;
  for (int y = 0; y < f.height; ++y) {
    for (int x = 30; x < f.width; ++x) f.paint(x, y, bar, bar, bar);
    f.paint(29, y, half, half, half);
  }
  const auto [front, behind] = f.parted();
  for (int y = 3; y < f.height - 3; ++y) {
    EXPECT_EQ(front.coc_quanta[f.at(29, y)], bar_coc) << y;
    EXPECT_NEAR(front.coverage[f.at(29, y)] / 65536.0, 0.5, 0.1) << y;
  }
}

TEST(Split, AntialiasedDepthBetweenTwoSurfacesIsNoThird) {
  // A ramp of two pixels between a bar and the plane, in depth as in colour, or nearly so.
  Canvas f(50, 20);
  f.add_bar(30, 50, bar_coc);
  f.each([&](int x, int y) {
    const float a = x < 28 ? 0 : x == 28 ? 0.25f : x == 29 ? 0.7f : 1;
    f.paint(x, y, 0.8f - 0.6f * a + (x == 28 ? 0.01f : 0), 0.7f - 0.2f * a, 0.1f + 0.5f * a);
    if (a > 0 && a < 1) {
      f.coc[f.at(x, y)] = 1536 - static_cast<std::int32_t>(a * (1536 - bar_coc));
      f.inverse[f.at(x, y)] = 0.2f + 0.3f * a;
    }
  });
  const auto [front, behind] = f.parted();
  for (int y = 3; y < f.height - 3; ++y) {
    EXPECT_EQ(front.coc_quanta[f.at(28, y)], f.coc[f.at(29, y)]) << y;
    EXPECT_NEAR(front.coverage[f.at(28, y)] / 65536.0, 0.25 / 0.7, 0.03) << y;
  }
}

TEST(Split, AThinThingInFocusCoversWhatItsColourSaysAlongIt) {
  // A blade that grows wider from a sixteenth to the whole of a pixel, in focus; as depth saw it
  // everywhere, no pixel of it is pure.
  Canvas f(40, 17);
  const float blade = 1.5f, plane = 0.1f;
  const auto share = [&](int y) { return static_cast<float>(y + 1) / 16; };
  for (int y = 0; y < 16; ++y) {
    const float c = share(y) * blade + (1 - share(y)) * plane;
    f.each([&](int x, int row) {
      if (row == y) f.paint(x, y, plane, plane, plane);
    });
    f.paint(20, y, c, c, c);
    f.coc[f.at(20, y)] = 0, f.inverse[f.at(20, y)] = 0.4f;
  }
  f.each([&](int x, int y) {
    if (y == 16) f.paint(x, y, plane, plane, plane);
  });
  const auto [front, behind] = f.parted();
  for (int y = 8; y < 14; ++y) {  // whose full width is 8 px away at most
    const std::size_t i = f.at(20, y);
    EXPECT_EQ(front.coc_quanta[i], 0);
    EXPECT_NEAR(front.coverage[i] / 65536.0, share(y), 0.05) << y;
    EXPECT_NEAR(front.channels[0][i], blade, 0.05) << y;
  }
  EXPECT_EQ(front.coverage[f.at(20, 15)], DEFRAY_WHOLE);
  // Nothing that is wider is near: as much as the widest within 8 px shows.
  EXPECT_NEAR(front.coverage[f.at(20, 5)] / 65536.0, share(5) / share(13), 0.05);
}

TEST(Split, WhatIsNotFiniteStaysWhole) {
  for (const float odd : {infinite, -infinite, nan}) {
    Canvas f = bar_with_mixed_edges(0.5f, true);
    f.paint(24, 10, odd, 0.5f, 0.5f);
    const auto [front, behind] = f.parted();
    const std::size_t i = f.at(24, 10);
    EXPECT_EQ(front.coverage[i], DEFRAY_WHOLE);
    expect_same_bits({front.channels[0][i]}, {odd});
    for (std::size_t k = 0; k < f.count(); ++k) {
      if (k != i) {
        EXPECT_TRUE(std::isfinite(front.channels[0][k])) << k;
      }
      EXPECT_TRUE(std::isfinite(behind.channels[0][k])) << k;
    }
  }
}

}  // namespace
}  // namespace defray::test::split_test
