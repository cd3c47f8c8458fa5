// Edges and changes that a truth has not, against closed forms.
#include "measure/false_edges.h"

#include <cmath>

#include "base/srgb.h"
#include "support.h"

namespace defray::test::false_edges_test {
namespace {

constexpr int width = 20, height = 9;

using Picture = std::vector<Plane>;

/// Grey of encoded values in 255ths.
template <typename Value>
Picture grey(const Value& value) {
  Plane plane;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      plane.push_back(static_cast<float>(srgb_decode(value(x, y) / 255.0)));
    }
  }
  return Picture(3, plane);
}

Picture flat() {
  return grey([](int, int) { return 100; });
}

/// Of two columns beside the step, a gradient of half its height.
Picture step(int at, int up = 40) {
  return grey([=](int x, int) { return x < at ? 100 : 100 + up; });
}

TEST(FalseEdges, OfTheTruthItselfAreNone) {
  const Excess found = false_edges(step(7), step(7), width);
  EXPECT_EQ(found.rms, 0);
  EXPECT_EQ(found.p999, 0);
  EXPECT_EQ(found.worst, 0);
}

TEST(FalseEdges, AStepWhereTheTruthIsFlat) {
  const Excess found = false_edges(step(7), flat(), width);
  EXPECT_NEAR(found.worst, 20, 1e-4);
  EXPECT_NEAR(found.p999, 20, 1e-4);
  EXPECT_NEAR(found.rms, 20 * std::sqrt(2.0 / width), 1e-4);
  EXPECT_TRUE(found.worst_x == 6 || found.worst_x == 7) << found.worst_x;
}

TEST(FalseEdges, WhatTheTruthHasMoreOfIsNone) {
  EXPECT_NEAR(false_edges(flat(), step(7), width).worst, 0, 1e-4);
  EXPECT_NEAR(false_edges(step(7), step(7, 60), width).worst, 0, 1e-4);
  EXPECT_NEAR(false_edges(step(7, 60), step(7), width).worst, 10, 1e-4) << "what is above it";
}

TEST(FalseEdges, TwoPixelsAsideAreNone) {
  EXPECT_NEAR(false_edges(step(9), step(7), width).worst, 0, 1e-4);
  EXPECT_NEAR(false_edges(step(10), step(7), width).worst, 20, 1e-4);
  EXPECT_EQ(false_edges(step(10), step(7), width).worst_x, 10);
  EXPECT_EQ(false_edges(step(4), step(7), width).worst_x, 3);
}

TEST(FalseEdges, UpwardsAndSlanting) {
  const Picture level = grey([](int, int y) { return y < 6 ? 90 : 100; });
  const Excess found = false_edges(level, flat(), width);
  EXPECT_NEAR(found.worst, 5, 1e-4);
  EXPECT_TRUE(found.worst_y == 5 || found.worst_y == 6) << found.worst_y;
  const Picture slope = grey([](int x, int y) { return 100 + 3 * x + 4 * y; });
  const Excess of_slope = false_edges(slope, flat(), width);
  EXPECT_NEAR(of_slope.worst, 5, 1e-4);
  EXPECT_NEAR(of_slope.rms, 5, 1e-4) << "at the frame's edges, too";
}

TEST(FalseEdges, WeighChannelsAsTheEyeDoes) {
  Picture red = flat(), green = flat(), blue = flat();
  red[0] = step(7)[0];
  green[1] = step(7)[1];
  blue[2] = step(7)[2];
  EXPECT_NEAR(false_edges(red, flat(), width).worst, 20 * 0.2126, 1e-4);
  EXPECT_NEAR(false_edges(green, flat(), width).worst, 20 * 0.7152, 1e-4);
  EXPECT_NEAR(false_edges(blue, flat(), width).worst, 20 * 0.0722, 1e-4);
}

TEST(FalseEdges, OfAThousandPixelsOneMayBeWorse) {
  Picture dots(3, Plane(2000, 0.5f));
  const Picture plain = dots;
  // Of a single row; a dot has a gradient on both sides.
  for (Plane& plane : dots) plane[100] = 1;
  EXPECT_EQ(false_edges(dots, plain, 2000).p999, 0) << "2 of 2000";
  for (Plane& plane : dots) plane[300] = 1;
  const Excess found = false_edges(dots, plain, 2000);
  EXPECT_GT(found.p999, 10) << "4 of 2000";
  EXPECT_EQ(found.p999, found.worst);
}

TEST(FalseEdges, NanIsNeverGood) {
  Picture bad = flat();
  bad[1][5] = NAN;
  EXPECT_TRUE(std::isnan(false_edges(bad, flat(), width).rms));
  EXPECT_TRUE(std::isnan(false_edges(flat(), bad, width).p999));
  EXPECT_TRUE(std::isnan(false_edges(bad, bad, width).worst));
}

TEST(FalseEdges, OneByOne) {
  const Picture one(3, Plane(1, 0.5f));
  EXPECT_EQ(false_edges(one, one, 1).worst, 0);
}

TEST(FalseEdges, AColumnOfPixelsHasEdgesAlongItAlone) {
  const float low = static_cast<float>(srgb_decode(100 / 255.0));
  const Plane even(6, low);
  Plane stepped = even;
  for (int i = 3; i < 6; ++i) stepped[size(i)] = static_cast<float>(srgb_decode(140 / 255.0));
  const Excess found = false_edges(Picture(3, stepped), Picture(3, even), 1);
  EXPECT_NEAR(found.worst, 20, 1e-4);
  EXPECT_NEAR(found.rms, 20 * std::sqrt(2.0 / 6), 1e-4);
}

TEST(FalseEdges, NeedPicturesOfOneSize) {
  expect_error(ErrorKind::usage, {"differ in size"},
               [] { false_edges(flat(), Picture(3, Plane(4)), width); });
}

TEST(FalseChanges, AreThoseTheTruthHasNotWithinTwoPixels) {
  const auto dot = [](int at, int value) {
    return grey([=](int x, int y) { return x == at && y == 4 ? value : 100; });
  };
  const Excess found = false_changes(flat(), dot(8, 130), flat(), flat(), width);
  EXPECT_NEAR(found.worst, 30, 1e-4);
  EXPECT_EQ(found.worst_x, 8);
  EXPECT_EQ(found.worst_y, 4);
  EXPECT_NEAR(found.rms, 30 / std::sqrt(width * height), 1e-4);
  EXPECT_NEAR(false_changes(flat(), dot(8, 70), flat(), flat(), width).worst, 30, 1e-4) << "darker";
  EXPECT_NEAR(false_changes(flat(), dot(8, 130), flat(), dot(10, 120), width).worst, 10, 1e-4);
  EXPECT_NEAR(false_changes(flat(), dot(8, 130), flat(), dot(11, 120), width).worst, 30, 1e-4);
  EXPECT_NEAR(false_changes(dot(8, 130), dot(8, 130), flat(), flat(), width).worst, 0, 1e-4)
      << "what stays does not flicker";
}

TEST(FalseChanges, NeedPicturesOfOneSize) {
  const Picture small(3, Plane(4));
  const auto refused = [](const Picture& a, const Picture& b, const Picture& c) {
    expect_error(ErrorKind::usage, {"differ in size"},
                 [&] { false_changes(flat(), a, b, c, width); });
  };
  refused(small, flat(), flat());
  refused(flat(), small, flat());
  refused(flat(), flat(), small);
}

}  // namespace
}  // namespace defray::test::false_edges_test
