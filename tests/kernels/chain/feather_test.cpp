// Kernel feather: what it does to edges between made-up surfaces. That it equals its twin in frames
// of all kinds: 'defray validate'.
#include <algorithm>
#include <cmath>
#include <limits>

#include "faults/fault.h"
#include "numbers.h"
#include "reference/twin_backend.h"
#include "stages_support.h"

namespace defray::test::feather_test {
namespace {

constexpr int width = 37, height = 21, edge_x = 17, edge_y = 10;
constexpr std::int32_t near_coc = 300, far_coc = near_coc + DEFRAY_JUMP_QUANTA + 1;

/// Two surfaces behind all of a frame: 0.25 left of an edge, 0.75 right of it.
struct MadeUp {
  Canvas canvas{width, height};
  std::vector<std::int32_t> seen;
  std::vector<std::uint32_t> marks, strips;

  MadeUp()
      : seen(canvas.count(), near_coc - DEFRAY_JUMP_QUANTA - 1),  // another surface
        marks(canvas.count()),
        strips(canvas.count()) {
    canvas.each([&](int x, int y) {
      const bool is_near = x < edge_x;
      canvas.coc[canvas.at(x, y)] = is_near ? near_coc : far_coc;
      const float c = is_near ? 0.25f : 0.75f;
      canvas.paint(x, y, c, c, c);
    });
  }
  Planes feathered() const { return device().feather(canvas.view(), seen, marks, strips); }
  float at(int x, int y) const { return feathered()[0][canvas.at(x, y)]; }
};

TEST(Feather, ColoursRunIntoEachOtherAtAnEdge) {
  const MadeUp f;
  // By weights 9 - x^2 - y^2 of a square of 5 px: columns of 15, 30, 35, 30, 15.
  EXPECT_FLOAT_EQ(f.at(edge_x - 3, edge_y), 0.25f);
  EXPECT_FLOAT_EQ(f.at(edge_x - 2, edge_y), 0.25f + 0.5f * 15 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x - 1, edge_y), 0.25f + 0.5f * 45 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x, edge_y), 0.75f - 0.5f * 45 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x + 1, edge_y), 0.75f - 0.5f * 15 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x + 2, edge_y), 0.75f);
  // Nothing beyond the frame counts: columns of 10, 19, 22, 19, 10.
  EXPECT_FLOAT_EQ(f.at(edge_x - 1, 0), 0.25f + 0.5f * 29 / 80);
}

TEST(Feather, OneSurfaceStaysBitForBit) {
  MadeUp f;
  f.canvas.each([&](int x, int y) {
    f.canvas.coc[f.canvas.at(x, y)] = near_coc + DEFRAY_JUMP_QUANTA * (x >= edge_x);
    f.canvas.paint(x, y, 0.1f * static_cast<float>(x % 7), -0.0f, 1);
  });
  const Planes out = f.feathered();
  for (std::size_t c = 0; c < 4; ++c) expect_same_bits(out[c], f.canvas.channels[c]);
}

TEST(Feather, OneColourStaysBitForBit) {
  for (const float colour :
       {0.1f, -0.0f, 1e-45f, std::numeric_limits<float>::max(), infinite, nan}) {
    MadeUp f;
    f.canvas.channels.assign(4, Plane(f.canvas.count(), colour));
    for (const Values<float>& channel : f.feathered()) {
      expect_same_bits(channel, f.canvas.channels[0]);
    }
  }
}

TEST(Feather, WhereNothingLiesBehindNothingCounts) {
  MadeUp f;
  const auto hide = [&](int x0, int x1) {
    f.canvas.each([&](int x, int y) {
      if (x >= x0 && x < x1) f.canvas.inverse[f.canvas.at(x, y)] = -1;
    });
  };
  hide(edge_x, width);
  EXPECT_EQ(f.at(edge_x - 1, edge_y), 0.25f);
  EXPECT_EQ(f.at(edge_x, edge_y), 0.75f);
  // A gap of one pixel in what was made up: no neighbours meet at it.
  f = MadeUp();
  hide(edge_x, edge_x + 1);
  EXPECT_EQ(f.at(edge_x - 1, edge_y), 0.25f);
  EXPECT_EQ(f.at(edge_x + 1, edge_y), 0.75f);
}

TEST(Feather, SilhouettesAndStripsStayHard) {
  for (const bool is_strip : {false, true}) {
    for (const int column : {edge_x - 1, edge_x}) {  // on either side
      MadeUp f;
      for (int y = 0; y < height; ++y) {
        (is_strip ? f.strips : f.marks)[f.canvas.at(column, y)] = DEFRAY_SILHOUETTE;
      }
      for (int x = edge_x - 2; x < edge_x + 2; ++x) {
        EXPECT_EQ(f.at(x, edge_y), x < edge_x ? 0.25f : 0.75f) << x << " " << column;
      }
    }
  }
  MadeUp mixed;
  mixed.marks.assign(mixed.marks.size(), DEFRAY_MIXED);
  EXPECT_NE(mixed.at(edge_x, edge_y), 0.75f);
  // As soon as it is not drawn all along.
  MadeUp f;
  for (int y = 0; y < edge_y; ++y) f.marks[f.canvas.at(edge_x, y)] = DEFRAY_SILHOUETTE;
  EXPECT_EQ(f.at(edge_x, edge_y - 3), 0.75f);
  EXPECT_NE(f.at(edge_x, edge_y - 2), 0.75f);
}

TEST(Feather, WhereASurfaceIsSeenItHasItsOwnColour) {
  MadeUp f;
  for (int y = 0; y < height; ++y) {  // the near one is seen beyond the edge, but for one column
    for (int x = edge_x + 1; x < width; ++x) f.seen[f.canvas.at(x, y)] = near_coc;
  }
  EXPECT_FLOAT_EQ(f.at(edge_x - 2, edge_y), 0.25f + 0.5f * 15 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x - 1, edge_y), 0.25f + 0.5f * 30 / 125);
  EXPECT_FLOAT_EQ(f.at(edge_x, edge_y), 0.75f - 0.5f * 45 / 125);  // not that one
  // As far from it as one surface may be.
  std::replace(f.seen.begin(), f.seen.end(), near_coc, near_coc - DEFRAY_JUMP_QUANTA);
  EXPECT_FLOAT_EQ(f.at(edge_x - 1, edge_y), 0.25f + 0.5f * 30 / 125);
}

TEST(Feather, AnEdgeAcrossRowsIsOneToo) {
  MadeUp f;
  f.canvas.each([&](int x, int y) {
    const bool is_near = y < edge_y;
    f.canvas.coc[f.canvas.at(x, y)] = is_near ? near_coc : far_coc;
    const float c = is_near ? 0.25f : 0.75f;
    f.canvas.paint(x, y, c, c, c);
  });
  EXPECT_FLOAT_EQ(f.at(5, edge_y - 1), 0.25f + 0.5f * 45 / 125);
  EXPECT_FLOAT_EQ(f.at(5, edge_y + 1), 0.75f - 0.5f * 15 / 125);
}

TEST(Feather, WhatIsNotFiniteStaysAndSpreadsNothing) {
  for (const float value : {nan, infinite}) {
    MadeUp f;
    f.canvas.channels[1][f.canvas.at(edge_x, edge_y)] = value;
    const Planes out = f.feathered();
    f.canvas.each([&](int x, int y) {
      const std::size_t i = f.canvas.at(x, y);
      const bool is_around = std::abs(x - edge_x) <= 2 && std::abs(y - edge_y) <= 2;
      if (is_around) EXPECT_EQ(std::isfinite(out[1][i]), x != edge_x || y != edge_y) << x;
      if (is_around && std::isfinite(out[1][i])) EXPECT_EQ(out[1][i], x < edge_x ? 0.25f : 0.75f);
      EXPECT_TRUE(std::isfinite(out[0][i]));
    });
    EXPECT_FLOAT_EQ(out[0][f.canvas.at(edge_x, edge_y)], 0.75f - 0.5f * 45 / 125);
  }
}

TEST(Feather, RadiiAtTheLimitsAreFarApart) {
  MadeUp f;
  f.canvas.each([&](int x, int y) {
    f.canvas.coc[f.canvas.at(x, y)] =
        x < edge_x ? -DEFRAY_COC_LIMIT_QUANTA : DEFRAY_COC_LIMIT_QUANTA;
  });
  EXPECT_FLOAT_EQ(f.at(edge_x, edge_y), 0.75f - 0.5f * 45 / 125);
  f.canvas.each([&](int x, int y) {
    f.canvas.coc[f.canvas.at(x, y)] = DEFRAY_TAME_QUANTA + (x < edge_x ? 0 : 1 << 20);
  });
  EXPECT_EQ(f.at(edge_x, edge_y), 0.75f);  // both have left every frame
}

const FaultRows faults{
    {"feather", "other weights", {"DEFRAY_FEATHER_WEIGHT - i * i", "DEFRAY_FEATHER_WEIGHT - i"}},
    {"feather",
     "last column of the square",
     {"i <= DEFRAY_FEATHER_PX; ++i", "i < DEFRAY_FEATHER_PX; ++i"}},
    {"feather",
     "last row of the square",
     {"j <= DEFRAY_FEATHER_PX; ++j", "j < DEFRAY_FEATHER_PX; ++j"}},
    {"feather",
     "what lies behind a surface that is seen colours it",
     {"weighs & are_two(coc, seen)", "weighs"}},
    {"feather",
     "what is seen weighs nothing",
     {"(float16)(weight), weighs)", "(float16)(weight), differs)"}},
    {"feather", "seen surfaces count", {"b->inverse, at) >= 0.0f)", "b->inverse, at) >= -2.0f)"}},
    {"feather",
     "left of the frame counts",
     {"(x >= (int16)(0)) & (x < (int16)((int)b->width))", "(x < (int16)((int)b->width))"}},
    {"feather",
     "above the frame counts",
     {"at.y < 0 || at.y >= (int)b->height", "at.y >= (int)b->height"}},
    {"feather", "below the frame counts", {"at.y < 0 || at.y >= (int)b->height", "at.y < 0"}},
    {"feather",
     "silhouettes are soft",
     {"(marks & (int16)(DEFRAY_SILHOUETTE)) != (int16)(0)", "(int16)(0)"}},
    {"feather", "any mark is a silhouette", {"(marks & (int16)(DEFRAY_SILHOUETTE))", "marks"}},
    {"feather", "strips are soft", {" | (strips != (int16)(0))", ""}},
    {"feather", "drawn on both", {"~(a->is_drawn | b->is_drawn)", "~(a->is_drawn & b->is_drawn)"}},
    {"feather", "steps of a surface part it", {"(int16)(DEFRAY_JUMP_QUANTA);", "(int16)(96);"}},
    {"feather", "no edges across rows", {"if (j > 0) is_edge", "if (j > 99) is_edge"}},
    {"feather", "no edges across columns", {"if (i > 0) is_edge", "if (i > 99) is_edge"}},
    {"feather", "pixels that were seen change", {"is_edge & there_of_run(b, start)", "is_edge"}},
    {"feather",
     "everything is feathered",
     {"is_edge & (difference != 0.0f)", "(difference != 0.0f)"}},
    {"feather", "NaN spreads", {" & isfinite(mean)", ""}},
    {"feather",
     "a channel twice",
     {"store_floats(p.width, out1, start, own1)", "store_floats(p.width, out1, start, own0)"}},
    {"feather",
     "stale output where nothing lies behind",
     {"  store_floats(p.width, out0", "  if (any_lane(is_edge)) store_floats(p.width, out0"}},
};

}  // namespace
}  // namespace defray::test::feather_test
