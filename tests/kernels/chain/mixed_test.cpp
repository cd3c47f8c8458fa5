// Kernels repair and mixed: anti-aliased depth, and where one surface ends before another.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "chain/chain.h"
#include "faults/fault.h"
#include "scenes/subject.h"
#include "stages_support.h"

namespace defray::test::mixed_test {
namespace {

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

/// An eighth of the step: as good as on the surface.
bool is_close(int a, int b) { return std::abs(a - b) <= 1024 / 8; }

/// Number of pixels that were on neither surface, and now are on one.
int expect_ramp_repaired(const std::vector<std::int32_t>& coc) {
  const Words source = device().repair({side, side, coc});
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
    std::vector<std::uint32_t> own(coc.size());
    std::iota(own.begin(), own.end(), 0u);
    EXPECT_EQ(device().repair({side, side, coc}), Words(own));
  };
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    expect_untouched(step_along(dx, dy, 0, 0.25, 1));
    auto small = step_along(dx, dy, 1, 0, 1);
    for (std::int32_t& c : small) c /= 2;  // 512 quanta: not above a ramp's
    expect_untouched(small);
    std::vector<std::int32_t> slope;
    for (int i = 0; i < side * side; ++i)
      slope.push_back(700 * (dx * (i % side) + dy * (i / side)));
    // At the frame's edge a slope's end cannot be told from a flat surface's.
    const Words source = device().repair({side, side, slope});
    for (int y = 4; y < side - 4; ++y) {
      for (int x = 4; x < side - 4; ++x) {
        EXPECT_EQ(source[static_cast<std::size_t>(y * side + x)],
                  static_cast<std::uint32_t>(y * side + x));
      }
    }
  }
}

/// Pixels that the chain repairs of a built-in scene's picture.
std::size_t repaired(const std::string& scene, int width, int height, bool is_antialiased) {
  Subject s = make_subject(device(), make_scene(scene, width, height),
                           make_scene(scene, 8, 8).settings[0].name);
  if (is_antialiased) s.pinhole.depth = render_pinhole(s.scene, {16, true}).depth;
  s.coc = device().coc(s.lens, width, s.pinhole.depth);
  ChainSettings settings;
  settings.hidden = Hidden::off;
  RdbSettings rdb;
  rdb.cells_per_side = 2;
  return run_chain(s.frame(), settings, device()).report->repaired;
}

TEST(Repair, IsDoneWhereDepthWasAntialiasedAndNotForRimsOfRoundThings) {
  if (is_slow_device()) GTEST_SKIP() << "whole pictures";
  for (const auto& [scene, width] :
       {std::pair{"plate1", 640}, {"plate2", 320}, {"spheres", 320}, {"drift", 320}}) {
    EXPECT_EQ(repaired(scene, width, width * 3 / 4, false), 0u) << scene;
    EXPECT_GT(repaired(scene, width, width * 3 / 4, true), 100u) << scene;
  }
}

TEST(Mixed, BothSidesOfAStepAreMixedAndOneOfThreeQuartersOfAPixelIsNone) {
  Canvas f(12, 6);
  f.add_bar(4, 8);
  const Words mixed = f.mixed();
  f.each([&](int x, int y) {
    EXPECT_EQ(mixed[f.at(x, y)], x == 3 || x == 4 || x == 7 || x == 8) << x << " " << y;
  });
  for (std::int32_t& c : f.coc) c = c == 0 ? 1536 - DEFRAY_JUMP_QUANTA : c;
  for (const std::uint32_t m : f.mixed()) EXPECT_EQ(m, 0u);
}

/// Up to two pixels a pixel, upwards or downwards, from a level surface on and back to one; steeper
/// is a ramp between two.
TEST(Mixed, ASlopeIsOneSurfaceUpToTwoPixelsAPixel) {
  for (const int rise : {DEFRAY_JUMP_QUANTA + 1, -DEFRAY_RAMP_QUANTA / 2, DEFRAY_RAMP_QUANTA,
                         DEFRAY_RAMP_QUANTA + 1}) {
    for (const bool is_across : {true, false}) {
      Canvas f(40, 40);
      f.each(
          [&](int x, int y) { f.coc[f.at(x, y)] = rise * std::clamp(is_across ? x : y, 10, 30); });
      const Words mixed = f.mixed();
      const bool is_slope = rise <= DEFRAY_RAMP_QUANTA;
      f.each([&](int x, int y) {
        const int along = is_across ? x : y;
        EXPECT_EQ(mixed[f.at(x, y)], !is_slope && along >= 10 && along <= 30) << along;
      });
    }
  }
}

/// A step that does not go on as before, nor before as it goes on: an edge on a slope, of which the
/// next pixel's step is another; and the bend that a slope may have.
TEST(Mixed, AnEdgeOnASlopeIsSeen) {
  constexpr int slope = 256, edge = 20;
  for (const int bend : {DEFRAY_BEND_QUANTA, DEFRAY_BEND_QUANTA + 1}) {
    Canvas f(40, 3);
    f.each([&](int x, int y) { f.coc[f.at(x, y)] = slope * x + (x >= edge ? bend : 0); });
    const Words mixed = f.mixed();
    for (int x = 0; x < f.width; ++x) {
      const bool is_beside = x == edge || x == edge - 1;
      EXPECT_EQ(mixed[f.at(x, 1)], is_beside && bend > DEFRAY_BEND_QUANTA) << x;
    }
  }
}

const FaultRows faults{
    {"repair", "the other end of the ramp", {"side < 0 ? low : high", "side < 0 ? high : low"}},
    {"repair", "ties to the far end", {"<= abs(to_high) ? -1", "< abs(to_high) ? -1"}},
    {"repair", "falling ramps forgotten", {"abs(rise) > DEFRAY_RAMP", "rise > DEFRAY_RAMP"}},
    {"repair",
     "slopes taken for ramps",
     {"if (!is_steep || !is_between || !is_flat)", "if (!is_steep || !is_between)"}},
    {"repair",
     "as good as on a surface, and moved to it",
     {"abs(from_low) > abs(rise) / 8", "abs(from_low) > abs(rise) / 16"}},
    {"repair",
     "ramps of three jumps are level",
     {"largest <= (int16)(DEFRAY_RAMP_QUANTA / 2)",
      "largest <= (int16)(3 * DEFRAY_RAMP_QUANTA / 2)"}},
    {"repair",
     "CoC without its limit",
     {"return tame(coc_quanta[pixel]);", "return coc_quanta[pixel];"}},
    {"repair", "only ramps of one pixel", {"i < 16 && !done", "i < 4 && !done"}},
    {"repair", "last ramp found counts", {"i < 16 && !done", "i < 16"}},
    {"repair", "diagonal along x alone", {"(int2)(1, -1)}", "(int2)(1, 0)}"}},
    {"repair", "anti-diagonal the wrong way", {"(int2)(1, -1)}", "(int2)(1, 1)}"}},
    {"repair", "flatness beyond one end only", {"&& abs(after - high) < abs(rise) / 8", ""}},
    {"repair",
     "without a frame's edge pixels beyond it",
     {"clamp(at.y, 0, (int)height - 1)",
      "clamp(at.y, 0, (int)height - 2 > 0 ? (int)height - 2 : 0)"}},
    {"mixed",
     "sign: only towards the far side",
     {"largest = max(largest, apart(coc, own));\n    }\n  }\n  int16 is_mixed",
      "largest = max(largest, max(coc - own, (int16)(0)));\n    }\n  }\n  int16 is_mixed"}},
    {"mixed",
     "threshold counts",
     {"(other, own), DEFRAY_JUMP_QUANTA)", "(other, own), DEFRAY_JUMP_QUANTA - 1)"}},
    {"mixed",
     "threshold of half a pixel",
     {"(other, own), DEFRAY_JUMP_QUANTA)", "(other, own), DEFRAY_JUMP_QUANTA / 2)"}},
    {"mixed", "slopes have edges", {"| is_above(bend, DEFRAY_BEND_QUANTA)", "| 1"}},
    {"mixed", "slopes have no end", {"bend = min(apart", "bend = max(apart"}},
    {"mixed", "no bend", {"is_above(bend, DEFRAY_BEND_QUANTA)", "is_above(bend, 0)"}},
    {"mixed",
     "twice the bend",
     {"is_above(bend, DEFRAY_BEND_QUANTA)", "is_above(bend, 2 * DEFRAY_BEND_QUANTA)"}},
    {"mixed",
     "slopes of two pixels part",
     {"(other, own), DEFRAY_RAMP_QUANTA)", "(other, own), DEFRAY_RAMP_QUANTA - 1)"}},
    {"mixed", "steps the other way", {"start + 2 * d", "start - 2 * d"}},
    {"mixed",
     "one neighbour forgotten",
     {"for (int i = -1; i <= 1; ++i) is_mixed", "for (int i = -1; i < 1; ++i) is_mixed"}},
    {"mixed",
     "four neighbours alone",
     {"start, (int2)(i, j))", "start, (int2)(i, i == 0 ? j : 0))"}},
    {"mixed",
     "last neighbour in a row forgotten",
     {"for (int i = -1; i <= 1; ++i) {", "for (int i = -1; i < 1; ++i) {"}},
    {"mixed",
     "row below forgotten",
     {"0;\n  for (int j = -1; j <= 1; ++j)", "0;\n  for (int j = -1; j < 1; ++j)"}},
    {"mixed",
     "neighbour's x and y swapped, twice the same",
     {"start + (int2)(i, j)", "start + (int2)(i, i)"}},
    {"mixed",
     "CoC without its limit",
     {"return clamp(ints_of_run(width, height, coc_quanta, at), (int16)(-DEFRAY_TAME_QUANTA),\n"
      "               (int16)(DEFRAY_TAME_QUANTA));",
      "return ints_of_run(width, height, coc_quanta, at);"}},
    {"mixed",
     "a run's last pixel from the next row",
     {"at.x + RUN > (int)width)", "at.x + RUN > (int)width + 1)"}},
    {"mixed",
     "a run beyond the frame not written",
     {"i < count; ++i) to[i] = lanes[i];", "i < count - 1; ++i) to[i] = lanes[i];"}},
    {"mixed",
     "stale output: only runs with mixed pixels written",
     {"  store_ints(p.width, (__global int*)mixed",
      "  if (any_lane(is_mixed)) store_ints(p.width, (__global int*)mixed"}},
};

}  // namespace
}  // namespace defray::test::mixed_test
