// Kernel mixed: where one surface ends before another.
#include <algorithm>

#include "faults/fault.h"
#include "stages_support.h"

namespace defray::test::mixed_test {
namespace {

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
