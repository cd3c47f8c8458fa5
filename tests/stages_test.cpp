// The stages before the RDB by their meaning: what is behind, in front, mixed. That kernels equal
// their twins in all kinds of frames: 'defray validate'.
#include "stages.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "reference/stages.h"
#include "support.h"

namespace defray::test {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

using Words = std::vector<std::uint32_t>;

/// A frame to draw on: a plane 6 px of CoC behind the focus, 1/depth 0.2, black.
struct Frame {
  int width, height;
  std::vector<std::int32_t> coc;
  Plane inverse;
  std::vector<Plane> channels;

  Frame(int w, int h) : width(w), height(h), coc(count(), 1536), inverse(count(), 0.2f) {
    channels.assign(4, Plane(count()));
    channels[3].assign(count(), 1.0f);
  }
  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  FrameView view() const { return {width, height, coc, inverse, channels}; }
  Words mixed() const { return edges(session(), width, height, coc); }
  Surface filled() const { return fill(session(), view(), mixed()); }
  Surfaces parted() const { return split(session(), view(), mixed(), filled()); }

  void paint(int x, int y, float r, float g, float b) {
    channels[0][at(x, y)] = r;
    channels[1][at(x, y)] = g;
    channels[2][at(x, y)] = b;
  }
  void each(const std::function<void(int, int)>& visit) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) visit(x, y);
    }
  }
  /// A bar in focus from column x0 up to x1, 1/depth 0.5.
  void add_bar(int x0, int x1) {
    for (int y = 0; y < height; ++y) {
      for (int x = x0; x < x1; ++x) {
        coc[at(x, y)] = 0;
        inverse[at(x, y)] = 0.5f;
      }
    }
  }
};

/// Bits, so that NaN equals itself and -0 is not 0.
void expect_same_bits(const Plane& a, const Plane& b) { EXPECT_EQ(hash_of({a}), hash_of({b})); }

// repair ------------------------------------------------------------------------------------------

constexpr int side = 21;

/// CoC of two surfaces, 0 and 1024 quanta, parted by a line across (dx, dy) through the middle,
/// `offset_px` away; over `width_px` around it depth is anti-aliased.
std::vector<std::int32_t> step_along(int dx, int dy, double width_px, double offset_px, int sign) {
  std::vector<std::int32_t> coc;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double along = ((x - side / 2) * dx + (y - side / 2) * dy) / std::hypot(dx, dy);
      const double from_line = along - offset_px;
      const double share = width_px > 0 ? std::clamp(0.5 + from_line / width_px, 0.0, 1.0)
                                        : (from_line > 0 ? 1.0 : 0.0);
      coc.push_back(sign * static_cast<std::int32_t>(1024 * share));
    }
  }
  return coc;
}

/// A quarter of a pixel in CoC: as good as on the surface.
bool is_close(int a, int b) { return std::abs(a - b) <= DEFRAY_JUMP_QUANTA / 4; }

/// Number of pixels that were on neither surface, and now are on one.
int expect_ramp_repaired(const std::vector<std::int32_t>& coc) {
  const Words source = repair(session(), side, side, coc);
  int ramps = 0;
  for (int y = 4; y < side - 4; ++y) {
    for (int x = 4; x < side - 4; ++x) {
      const auto i = static_cast<std::size_t>(y * side + x);
      const int before = std::abs(coc[i]), after = std::abs(coc[source[i]]);
      EXPECT_TRUE(is_close(after, 0) || is_close(after, 1024)) << x << " " << y << ": " << after;
      if (!is_close(before, 512)) {  // the nearer one
        EXPECT_EQ(after > 512, before > 512) << x << " " << y;
      }
      if (before == 0 || before == 1024) {
        EXPECT_EQ(source[i], i);
      }
      ramps += !is_close(before, 0) && !is_close(before, 1024);
    }
  }
  return ramps;
}

TEST(Repair, AntiAliasedDepthIsPutOnOneOfTheTwoSurfaces) {
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}, {-1, 0}, {-1, -1}}) {
    for (const double width_px : {1.0, 1.5, 2.0}) {
      for (const double offset_px : {0.0, 0.25, -0.25, 0.5}) {
        for (const int sign : {1, -1}) {
          SCOPED_TRACE(fmt::format("({}, {}), {} px at {}", dx, dy, width_px, offset_px));
          const int ramps = expect_ramp_repaired(step_along(dx, dy, width_px, offset_px, sign));
          const bool is_on_pixel_border = width_px == 1 && offset_px == 0.5 && dx * dy == 0;
          EXPECT_EQ(ramps > 0, !is_on_pixel_border);
        }
      }
    }
  }
}

TEST(Repair, SharpEdgesSlopesAndSmallStepsStay) {
  const auto expect_untouched = [](const std::vector<std::int32_t>& coc) {
    Words own(coc.size());
    std::iota(own.begin(), own.end(), 0u);
    EXPECT_EQ(repair(session(), side, side, coc), own);
  };
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    expect_untouched(step_along(dx, dy, 0, 0.25, 1));
    auto small = step_along(dx, dy, 1, 0, 1);
    for (std::int32_t& c : small) c /= 2;  // 512 quanta: not above two jumps
    expect_untouched(small);
    std::vector<std::int32_t> slope;
    for (int i = 0; i < side * side; ++i)
      slope.push_back(700 * (dx * (i % side) + dy * (i / side)));
    // At the frame's edge a slope's end cannot be told from a flat surface's.
    const Words source = repair(session(), side, side, slope);
    for (int y = 4; y < side - 4; ++y) {
      for (int x = 4; x < side - 4; ++x) {
        EXPECT_EQ(source[static_cast<std::size_t>(y * side + x)],
                  static_cast<std::uint32_t>(y * side + x));
      }
    }
  }
}

// edges -------------------------------------------------------------------------------------------

TEST(Edges, BothSidesOfAStepAreMixedAndOneStepOfAPixelIsNone) {
  Frame f(12, 6);
  f.add_bar(4, 8);
  const Words mixed = f.mixed();
  f.each([&](int x, int y) {
    EXPECT_EQ(mixed[f.at(x, y)], x == 3 || x == 4 || x == 7 || x == 8) << x << " " << y;
  });
  for (std::int32_t& c : f.coc) c = c == 0 ? 1536 - 256 : c;
  for (const std::uint32_t m : f.mixed()) EXPECT_EQ(m, 0u);
}

// fill --------------------------------------------------------------------------------------------

TEST(Fill, BehindABarThePlaneGoesOn) {
  Frame f(60, 40);
  f.each([&](int x, int y) { f.paint(x, y, 0.25f, 0.5f, 0.75f); });
  for (int y = 0; y < f.height; ++y) {
    for (int x = 27; x < 33; ++x) f.paint(x, y, 1, 0, 0);
  }
  f.add_bar(27, 33);
  const Surface behind = f.filled();
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

/// Ways in 16 directions end in whole pixels: a source lies up to half a pixel beside its way, and
/// its slant, taken over 4 pixels, is off by up to a pixel's in them. t pixels away that leaves at
/// worst 1/2 + t / 4 of the slant a pixel, where a plane without slant would be off by t.
TEST(Fill, BehindAnEdgeASlantedPlaneKeepsItsSlant) {
  for (const double slant : {12.0, -40.0}) {
    Frame f(80, 60);
    f.each([&](int x, int y) {
      f.coc[f.at(x, y)] = static_cast<std::int32_t>(3000 + slant * (x - 40));
      f.inverse[f.at(x, y)] = static_cast<float>(0.2 - slant * 1e-4 * (x - 40));
    });
    const std::vector<std::int32_t> plane = f.coc;
    const Plane plane_inverse = f.inverse;
    f.add_bar(36, 80);
    const Surface behind = f.filled();
    for (int y = 25; y < 35; ++y) {
      for (int x = 37; x < 43; ++x) {
        const std::size_t i = f.at(x, y);
        const double t = x - 34;  // 35 is mixed
        EXPECT_NEAR(behind.coc_quanta[i], plane[i], std::fabs(slant) * (0.5 + t / 4)) << x;
        EXPECT_NEAR(behind.inverse[i], plane_inverse[i], std::fabs(slant) * 1e-4 * (0.5 + t / 4));
      }
    }
  }
}

/// Rows alone: one way left and one right, both exact.
TEST(Fill, BehindABarInARowTheSlantIsExact) {
  Frame f(81, 1);
  f.each([&](int x, int y) {
    f.coc[f.at(x, y)] = 1536 + 16 * (x - 40);
    f.inverse[f.at(x, y)] = 0.2f - (x - 40) / 1024.0f;
  });
  const std::vector<std::int32_t> plane = f.coc;
  const Plane plane_inverse = f.inverse;
  f.add_bar(37, 44);
  const Surface behind = f.filled();
  for (int x = 37; x < 44; ++x) {
    EXPECT_EQ(behind.coc_quanta[f.at(x, 0)], plane[f.at(x, 0)]) << x;
    EXPECT_NEAR(behind.inverse[f.at(x, 0)], plane_inverse[f.at(x, 0)], 0x1p-22f) << x;
  }
}

TEST(Fill, ReachesAsFarAsTheLensSeesPastTheEdgeAndNoFurther) {
  Frame f(200, 3);
  f.add_bar(50, 200);
  const Surface behind = f.filled();
  int filled = 0;
  for (int x = 50; x < 200; ++x) {
    const bool is_there = behind.inverse[f.at(x, 1)] >= 0;
    filled += is_there;
    // 6 px of CoC, 2 more; the plane's last pixel is 49.
    EXPECT_EQ(is_there, x - 49 <= 6 + 2) << x;
    EXPECT_EQ(behind.coc_quanta[f.at(x, 1)], is_there ? 1536 : 0) << x;
  }
  EXPECT_EQ(filled, 8);
}

TEST(Fill, NothingLiesBehindTheFarthestOrBesideItself) {
  Frame f(60, 20);
  f.add_bar(20, 26);
  const Surface behind = f.filled();
  // Mixed pixels of the plane have the bar in front of them; pure ones nothing.
  f.each([&](int x, int y) {
    if (x < 19 || x > 26) {
      EXPECT_EQ(behind.inverse[f.at(x, y)], -1.0f) << x << " " << y;
    }
  });
  Frame slope(60, 20);  // steep, but one surface
  slope.each([&](int x, int y) { slope.coc[slope.at(x, y)] = 250 * x; });
  for (const float i : slope.filled().inverse) EXPECT_EQ(i, -1.0f);
}

TEST(Fill, ANearerSurfaceNeverFills) {
  Frame f(60, 20);
  for (std::int32_t& c : f.coc) c = 0;
  f.each([&](int x, int y) {
    if (x >= 20 && x < 40) f.coc[f.at(x, y)] = -1536;
    f.paint(x, y, f.coc[f.at(x, y)] < 0 ? 1 : 0, 0, 0);
  });
  const Surface behind = f.filled();
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
    Frame f(60, 40);
    f.each([&](int x, int y) { f.paint(x, y, 0.5f, 0.5f, 0.5f); });
    f.add_bar(27, 33);
    f.paint(34, 20, highlight, highlight, highlight);
    const Surface behind = f.filled();
    for (int y = 0; y < f.height; ++y) {
      for (int x = 28; x < 32; ++x) EXPECT_NEAR(behind.channels[0][f.at(x, y)], 0.5f, 0x1p-20f);
    }
  }
}

// split -------------------------------------------------------------------------------------------

/// A bar over the plane whose edges cover their pixels by `share`; depth sees the bar or the plane.
Frame bar_with_mixed_edges(float share, bool saw_front) {
  Frame f(60, 20);
  const float front[3] = {2.0f, 1.5f, 0.1f}, behind[3] = {0.1f, 0.2f, 1.8f};
  f.add_bar(saw_front ? 24 : 25, saw_front ? 36 : 35);
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
      const Frame f = bar_with_mixed_edges(share, saw_front);
      const auto [front, behind] = f.parted();
      for (int y = 0; y < f.height; ++y) {
        for (const int x : {24, 35}) {
          const std::size_t i = f.at(x, y);
          const double a = front.coverage[i] / 65536.0;
          EXPECT_NEAR(a, share, 1e-3);  // drawn to what is likely by 1e-3 |F|^2 / |F - B|^2
          EXPECT_EQ(front.coc_quanta[i], 0);
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

TEST(Split, WithoutAStepNothingChanges) {
  Frame f(31, 17);
  f.channels = {random_plane({31, 17}, 1), random_plane({31, 17}, 2)};
  f.channels[0][5] = -0.0f;
  f.channels[1][6] = nan;
  const auto [front, behind] = f.parted();
  for (std::size_t c = 0; c < 2; ++c) expect_same_bits(front.channels[c], f.channels[c]);
  expect_same_bits(front.inverse, f.inverse);
  EXPECT_EQ(front.coc_quanta, f.coc);
  for (std::size_t i = 0; i < f.count(); ++i) {
    EXPECT_EQ(front.coverage[i], DEFRAY_WHOLE);
    EXPECT_EQ(behind.inverse[i], -1.0f);
  }
}

TEST(Split, AThinBrightThingIsTakenApart) {
  // A line one pixel wide at half a pixel's offset: half in one column, half in the next.
  Frame f(40, 20);
  for (int y = 0; y < f.height; ++y) f.paint(19, y, 4, 4, 4);  // the part that depth saw
  for (int y = 0; y < f.height; ++y) f.paint(20, y, 1, 1, 1);  // a quarter of it
  f.add_bar(19, 20);
  const auto [front, behind] = f.parted();
  for (int y = 3; y < f.height - 3; ++y) {
    EXPECT_EQ(front.coverage[f.at(19, y)], DEFRAY_WHOLE);
    EXPECT_NEAR(front.coverage[f.at(20, y)] / 65536.0, 0.25, 2e-3);
    EXPECT_EQ(front.channels[0][f.at(20, y)], 4.0f);
    EXPECT_EQ(front.coc_quanta[f.at(20, y)], 0);
    EXPECT_NEAR(behind.channels[0][f.at(20, y)], 0.0f, 1e-2f);
    EXPECT_EQ(behind.coc_quanta[f.at(20, y)], 1536);
  }
}

TEST(Split, WhatIsNotFiniteStaysWhole) {
  for (const float odd : {infinite, -infinite, nan}) {
    Frame f = bar_with_mixed_edges(0.5f, true);
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

// soften ------------------------------------------------------------------------------------------

Fragments flat_fragments(int width, int height, int layers, double radius_px) {
  Fragments f{width, height, layers, {}, {}, {}, {}};
  const auto count = static_cast<std::size_t>(width * height * layers);
  f.coc_quanta.assign(count, static_cast<std::int32_t>(256 * radius_px));
  f.depth.assign(count, 2);
  f.coverage.assign(count, DEFRAY_WHOLE);
  f.channels.assign(1, Plane(count));
  return f;
}

TEST(Soften, OneColourStaysBitForBit) {
  for (const float colour :
       {0.1f, -0.0f, 1e-45f, std::numeric_limits<float>::max(), infinite, nan}) {
    Fragments f = flat_fragments(23, 17, 2, 40);
    f.channels[0].assign(f.coc_quanta.size(), colour);
    expect_same_bits(soften(session(), f, 16)[0], f.channels[0]);
  }
}

TEST(Soften, ACellBelowAPixelChangesNothing) {
  Fragments f = flat_fragments(23, 17, 1, 0);
  f.channels[0] = random_plane({23, 17}, 4);
  // The diameter is as many pixels as a grid has cells a side.
  const auto sharp = static_cast<std::int32_t>(128 * cells_a_side(64));
  for (const std::int32_t quanta : {0, sharp, -sharp}) {
    std::fill(f.coc_quanta.begin(), f.coc_quanta.end(), quanta);
    expect_same_bits(soften(session(), f, 64)[0], f.channels[0]);
  }
  std::fill(f.coc_quanta.begin(), f.coc_quanta.end(), 2 * sharp);
  EXPECT_NE(hash_of(soften(session(), f, 64)), hash_of(f.channels));
}

TEST(Soften, ABrightPixelIsSpreadOverTheCellAndKeepsItsEnergy) {
  for (const double radius : {6.0, -10.0, 20.0, 80.0}) {
    Fragments f = flat_fragments(101, 101, 1, radius);
    f.channels[0][f.index(50, 50, 0)] = 1000;
    const Plane out = soften(session(), f, 64)[0];
    const double cell = 2 * std::fabs(radius) / cells_a_side(64);
    double sum = 0;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        const float value = out[f.index(x, y, 0)];
        sum += value;
        EXPECT_GE(value, -1e-4f);
        const int away = std::max(std::abs(x - 50), std::abs(y - 50));
        if (away >= cell / 2 + 0.5) {
          EXPECT_EQ(value, 0.0f) << x << " " << y;
        }
      }
    }
    EXPECT_NEAR(sum, 1000, 1000 * 1e-5) << radius;
    EXPECT_LT(out[f.index(50, 50, 0)], 1000 / std::min(cell * cell, 49.0) * 1.7) << radius;
  }
}

TEST(Soften, SurfacesDoNotMixNorDoLayersOrEmptyOnes) {
  Fragments f = flat_fragments(40, 20, 2, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (x >= 20) f.coc_quanta[f.index(x, y, 0)] = 10 * 256;
      f.channels[0][f.index(x, y, 0)] = x >= 20 ? 1.0f : 0.25f;
      f.channels[0][f.index(x, y, 1)] = x % 5 == 0 ? 100.0f : 7.0f;
      if (x % 5 == 0) f.coverage[f.index(x, y, 1)] = DEFRAY_SYNTHESISED;  // covers nothing
    }
  }
  expect_same_bits(soften(session(), f, 16)[0], f.channels[0]);
}

TEST(Soften, WithoutCoverageEveryFragmentIsWhole) {
  Fragments f = flat_fragments(20, 20, 1, 20);
  f.channels[0] = random_plane({20, 20}, 3);
  const auto whole = soften(session(), f, 16);
  f.coverage.clear();
  EXPECT_EQ(hash_of(soften(session(), f, 16)), hash_of(whole));
  EXPECT_EQ(hash_of(reference::soften(f, 16)), hash_of(whole));
}

// all ---------------------------------------------------------------------------------------------

TEST(Stages, SmallFramesHugeCocAndOddColoursEqualTheTwins) {
  for (const Size size : {Size{1, 1}, {1, 9}, {9, 1}, {2, 2}, {17, 33}}) {
    for (const double coc_px : {8.0, 4194304.0}) {
      Frame f(size.width, size.height);
      for (std::size_t i = 0; i < f.count(); ++i) {
        f.coc[i] = static_cast<std::int32_t>(256 * coc_px * (i / 5 % 3 - 1.0));
        f.inverse[i] = i % 7 ? 0.1f * static_cast<float>(i % 7) : infinite;
        f.channels[0][i] = i % 11 == 0 ? nan : i % 5 == 0 ? infinite : 0.3f;
      }
      const Words source = repair(session(), f.width, f.height, f.coc);
      EXPECT_EQ(source, reference::repair(f.width, f.height, f.coc));
      for (const std::uint32_t s : source) EXPECT_LT(s, f.count());
      const Words mixed = reference::edges(f.width, f.height, f.coc);
      EXPECT_EQ(f.mixed(), mixed);
      const Surface behind = f.filled(), twin = reference::fill(f.view(), mixed);
      EXPECT_EQ(behind.coc_quanta, twin.coc_quanta);
      const auto [front, rest] = f.parted();
      const auto twins = reference::split(f.view(), mixed, twin);
      EXPECT_EQ(front.coverage, twins.front.coverage);
      EXPECT_EQ(rest.coc_quanta, twins.behind.coc_quanta);
    }
  }
}

}  // namespace
}  // namespace defray::test
