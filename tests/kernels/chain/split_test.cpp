// Kernel split: mixed pixels taken apart.
#include <cmath>
#include <limits>

#include "faults/fault.h"
#include "numbers.h"
#include "stages_support.h"

namespace defray::test::split_test {
namespace {

constexpr std::int32_t bar_coc = -512;  // an edge in focus would stay as it is

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

TEST(Split, AnEdgeInFocusStaysAsItIs) {
  Canvas f = bar_with_mixed_edges(0.5f, true);
  f.add_bar(24, 36, 255);
  const auto [front, behind] = f.parted();
  for (std::size_t c = 0; c < 3; ++c) expect_same_bits(front.channels[c], f.channels[c]);
  for (std::size_t i = 0; i < f.count(); ++i) EXPECT_EQ(front.coverage[i], DEFRAY_WHOLE);
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

/// A lamp of 5 x 5 px, and a dark blade of a pixel's width whose tip covers a third of three of
/// them.
Canvas lamp_behind_a_blade(float blade) {
  Canvas f(40, 20);
  f.each([&](int x, int y) {
    const bool is_lamp = x >= 18 && x < 23 && y >= 6 && y < 11, is_blade = x == 20 && y >= 8;
    const float there = is_lamp ? 60.0f : 0.1f;
    const float c = is_blade ? (is_lamp ? 2 * there / 3 + blade / 3 : blade) : there;
    f.paint(x, y, c, c, c);
    if (is_lamp) f.coc[f.at(x, y)] = 1400, f.inverse[f.at(x, y)] = 0.21f;
    if (is_blade) f.coc[f.at(x, y)] = bar_coc, f.inverse[f.at(x, y)] = 0.5f;
  });
  return f;
}

TEST(Split, ABladeBeforeALampHasNoneOfItsLight) {
  const Canvas f = lamp_behind_a_blade(0.3f);
  const auto [front, behind] = f.parted();
  for (std::size_t i = 0; i < f.count(); ++i) {
    if (front.coc_quanta[i] == bar_coc) EXPECT_LT(front.channels[0][i], 1) << i;
  }
  for (int y = 8; y < 11; ++y) {
    const std::size_t i = f.at(20, y);
    EXPECT_EQ(front.coc_quanta[i], bar_coc) << y;
    EXPECT_NEAR(front.coverage[i] / 65536.0, 1 / 3.0, 0.02) << y;
    EXPECT_NEAR(behind.channels[0][i], 60, 1) << y;
    EXPECT_EQ(behind.coc_quanta[i], 1400) << y;
    EXPECT_FLOAT_EQ(behind.depth[i], 1 / 0.21f) << y;
  }
  // One that is as bright as the lamp keeps its light.
  const Canvas bright = lamp_behind_a_blade(70);
  EXPECT_GT(bright.parted().front.channels[0][bright.at(20, 9)], 50);
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

const FaultRows faults{
    {"split", "no lamp is bright enough", {"LAMP * darkest", "INFINITY"}},
    {"split", "the darkest of all", {"LAMP * darkest", "0.0f"}},
    {"split", "lamps are in front", {"brightest > front ? LAMP", "brightest < front ? LAMP"}},
    {"split", "any farther pixel is a lamp", {"0.5f * brightness_of", "0.0f * brightness_of"}},
    {"split", "lit pixels are in front", {"best.is_thin && saw_front && b", "false && b"}},
    {"split",
     "lit colours are in front",
     {"if (is_bright && lamp_beside(", "if (false && lamp_beside("}},
    {"split", "a lit pixel keeps its depth", {"front->inverse = inverse[lamp];", ""}},
    {"split", "a lit pixel keeps its radius", {"front->coc = coc_quanta[lamp];", ""}},
    {"split", "a blade's depth beside it", {"      f.source = pixel;\n", ""}},
    {"split",
     "behind it what was made up",
     {"      b = colour_at(CHANNELS(channel), lamp);\n", ""}},
    {"split", "the nearest anywhere", {"least = nearest - DEFRAY_JUMP_QUANTA", "least = INT_MIN"}},
    {"split", "thin things nearer than those around", {"coc_of(coc_quanta, q) < least ||", ""}},
    {"split",
     "farther surfaces' pixels in front",
     {"min(front.middle - 1, nearest + DEFRAY_JUMP_QUANTA)", "front.middle - 1"}},
    {"split",
     "surfaces behind in front",
     {"min(front.middle - 1, nearest + DEFRAY_JUMP_QUANTA)", "nearest + DEFRAY_JUMP_QUANTA"}},
    {"split", "the nearest alone", {"return is_better ? other : front;", "return front;"}},
    {"split", "the second always", {"return is_better ? other : front;", "return other;"}},
    {"split",
     "the farthest is in front of itself",
     {"second >= farthest - DEFRAY_JUMP_QUANTA ||", ""}},
    {"split",
     "any CoC is a second one",
     {"coc > nearest + DEFRAY_JUMP_QUANTA) second", "coc > nearest) second"}},
    {"split",
     "any second one",
     {"if (coc > nearest + DEFRAY_JUMP_QUANTA) second = min(second, coc)",
      "if (coc > nearest + DEFRAY_JUMP_QUANTA) second = coc"}},
    {"split",
     "thin things' middle of others",
     {"front.middle = nearest + (farthest - nearest) / 2", "front.middle = farthest"}},
    {"split", "what is in front behind too", {"set_layer(behind, is", "set_layer(front, is"}},
    {"split",
     "made-up colours where those nearby explain the pixel",
     {"} else if (seen.is_found && f.is_found) {", "} else if (false) {"}},
    {"split",
     "the mean of those nearby forgotten",
     {"misfit2) best = mean;", "misfit2) best = made_up;"}},
    {"split",
     "background at a depth",
     {"s.inverse == 0.0f ? INFINITY", "s.inverse == 0.0f ? 1e9f"}},
    {"split", "depth where there is nothing", {"is_nothing ? as_float(DEFRAY_EMPTY) : z", "z"}},
    {"split", "coverage where there is nothing", {"is_nothing ? 0u : s.coverage", "s.coverage"}},
    {"split", "the margin was seen", {"is_in_margin ? DEFRAY_SYNTHESISED : 0u", "0u"}},
    {"split",
     "margin without its last column",
     {"x + p.margin >= p.width", "x + p.margin > p.width"}},
    {"split", "margin of a band, not of the frame", {"y = p.first_row + at.y", "y = at.y"}},
    {"split", "middle counts as front", {"own < best.middle", "own <= best.middle"}},
    {"split",
     "whole pixels as seen behind",
     {"DEFRAY_WHOLE | DEFRAY_SYNTHESISED,", "DEFRAY_WHOLE,"}},
    {"split",
     "far surface taken for the front",
     {"mixed[q] || coc < low || coc > high", "mixed[q] || coc < low"}},
    {"split",
     "mixed pixels taken for pure",
     {"mixed[q] || coc < low || coc > high", "(d.x == 0 && d.y == 0) || coc < low || coc > high"}},
    {"split",
     "nearer surface taken for the one that was seen",
     {"mixed[q] || coc < low || coc > high", "mixed[q] || coc > high"}},
    {"split",
     "three surfaces taken for two",
     {"abs(tame(behind->coc) - own) > DEFRAY_JUMP_QUANTA", "false"}},
    {"split",
     "own pixel taken for the surface that was seen",
     {"own + DEFRAY_JUMP_QUANTA", "own - 1"}},
    {"split",
     "last row of the neighbourhood",
     {"for (int i = 0; i < 49; ++i) {\n    const int2 d",
      "for (int i = 0; i < 42; ++i) {\n    const int2 d"}},
    {"split",
     "ties to the last in front",
     {"if (weight > nearest) found.source", "if (weight >= nearest) found.source"}},
    {"split",
     "thin things: the first for the least like",
     {"if (!(far > farthest_colour)) continue;", "if (front.is_found) continue;"}},
    {"split",
     "alpha forgotten",
     {"products.x + products.y + products.z + products.w", "products.x + products.y + products.z"}},
    {"split",
     "coverage beyond one",
     {"clamp(fit.along / fit.length2, 0.0f, 1.0f)", "fit.along / fit.length2"}},
    {"split",
     "depth sample's side forgotten",
     {"likely = saw_front ? LIKELY_COVERAGE : 1.0f - LIKELY_COVERAGE;",
      "likely = LIKELY_COVERAGE;"}},
    {"split", "any variance", {"fmin(LEAST_NOISE", "fmax(LEAST_NOISE"}},
    {"split", "variance behind forgotten", {"f.variance + seen.variance", "f.variance"}},
    {"split",
     "variance of the last colour",
     {"squares += weight * (colour * colour);", "squares = weights * (colour * colour);"}},
    {"split", "colours below 0", {"return rest < least ? least : rest;", "return rest;"}},
    {"split",
     "Inf and NaN taken apart",
     {"if (!isfinite(fit.along) || !isfinite(all2)) return saw_front ? 1.0f : 0.0f;", ""}},
    {"split",
     "seen fragment behind marked as made up",
     {"front->inverse, DEFRAY_WHOLE,", "front->inverse, behind->coverage,"}},
    {"split", "front keeps the far CoC", {"{coc_quanta[f.source], inverse", "{own, inverse"}},
    {"split",
     "any colour is plausible",
     {"return rest < low ? low : rest > high ? high : rest;", "return rest;"}},
    {"split",
     "pixels nearby say nothing of plausible colours",
     {"lower_of(seen.low, lower_of(b, c))", "lower_of(b, c)"}},
    {"split", "as high as the lowest", {"higher_of(colour, found.high)", "found.high"}},
    {"split", "stale fragment behind a pure pixel", {"behind->inverse = -1.0f;", ""}},
    {"split",
     "coverage rounded down",
     {"convert_uint_rte(share * 65536.0f)", "convert_uint_rtz(share * 65536.0f)"}},
};

}  // namespace
}  // namespace defray::test::split_test
