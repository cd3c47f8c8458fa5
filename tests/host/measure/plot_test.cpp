// Charts: points, texts and colours are where they must be; what cannot be drawn is refused.
#include "measure/plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/ldr.h"
#include "measure/plot_axis.h"
#include "support.h"

namespace defray::test::plot_test {
namespace {

Plot plot_of(std::vector<PlotPoint> points) {
  Plot plot{"Title", "x", "y"};
  plot.series.push_back({"", std::move(points), false, true});
  return plot;
}

LdrPicture drawn(const Plot& plot) {
  const Folder folder;
  write_plot(folder / "plot.png", plot);
  LdrPicture picture = read_ldr(folder / "plot.png", Content::data);
  EXPECT_EQ(picture.width, plot_width_px);
  EXPECT_EQ(picture.height, plot_height_px);
  return picture;
}

std::array<int, 3> colour_at(const LdrPicture& picture, double x, double y) {
  const auto i = static_cast<std::size_t>(std::lround(y) * picture.width + std::lround(x));
  std::array<int, 3> colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = std::lround(255 * picture.planes[c][i]);
  return colour;
}

/// Pixels of a rectangle whose colours differ.
int changed(const LdrPicture& a, const LdrPicture& b, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) count += colour_at(a, x, y) != colour_at(b, x, y);
  }
  return count;
}

constexpr std::array<int, 3> blue = {0, 114, 178}, vermilion = {213, 94, 0},
                             white = {255, 255, 255};

TEST(Plot, PointsLieWhereTheAxesSay) {
  const Plot plot = plot_of({{0, 0}, {10, 4}, {5, 1}});
  const auto origin = plot_position(plot, {0, 0}), end = plot_position(plot, {10, 4});
  EXPECT_LT(origin[0], end[0]);
  EXPECT_GT(origin[1], end[1]);  // y goes up
  const auto middle = plot_position(plot, {5, 1});
  EXPECT_NEAR(middle[0], (origin[0] + end[0]) / 2, 1e-9);
  EXPECT_NEAR(middle[1], origin[1] + (end[1] - origin[1]) / 4, 1e-9);
  const LdrPicture picture = drawn(plot);
  for (const auto& at : {origin, end, middle}) EXPECT_EQ(colour_at(picture, at[0], at[1]), blue);
  EXPECT_NE(colour_at(picture, middle[0] + 12, middle[1]), blue);
  // The first and the last value of each axis are on its frame, which is black.
  constexpr std::array<int, 3> black = {0, 0, 0};
  for (const auto& corner : {origin, end}) {
    EXPECT_EQ(colour_at(picture, corner[0], middle[1] - 20), black);
    EXPECT_EQ(colour_at(picture, middle[0] + 20, corner[1]), black);
  }
}

TEST(Plot, LogAxesSpaceDecadesEvenly) {
  Plot plot = plot_of({{1, 0.01}, {10, 1}, {100, 100}});
  plot.x_log = plot.y_log = true;
  const auto low = plot_position(plot, {1, 0.01}), high = plot_position(plot, {100, 100});
  const auto middle = plot_position(plot, {10, 1});
  EXPECT_NEAR(middle[0], (low[0] + high[0]) / 2, 1e-9);
  EXPECT_NEAR(middle[1], (low[1] + high[1]) / 2, 1e-9);
  const LdrPicture picture = drawn(plot);
  EXPECT_EQ(colour_at(picture, middle[0], middle[1]), blue);
}

TEST(Plot, LinesAndMarkersCanBeLeftOut) {
  Plot plot = plot_of({{0, 0}, {8, 8}});
  const auto middle = plot_position(plot, {4, 4}), end = plot_position(plot, {8, 8});
  EXPECT_NE(colour_at(drawn(plot), middle[0], middle[1]), blue);
  plot.series[0].lines = true;
  EXPECT_EQ(colour_at(drawn(plot), middle[0], middle[1]), blue);
  plot.series[0].markers = false;
  EXPECT_NE(colour_at(drawn(plot), end[0] - 4, end[1] - 1), blue);
}

/// How much of the picture is not as `empty`, in pixels: half of it where half is covered.
double covered_px(const LdrPicture& picture, const LdrPicture& empty,
                  const std::array<int, 3>& ink) {
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      // The channel in which the ink is farthest from white.
      const auto c =
          static_cast<std::size_t>(std::min_element(ink.begin(), ink.end()) - ink.begin());
      const double white_px = colour_at(empty, x, y)[c], now = colour_at(picture, x, y)[c];
      if (now != white_px) sum += (white_px - now) / (white_px - ink[c]);
    }
  }
  return sum;
}

TEST(Plot, MarkersAreDiscsSquaresDiamondsAndTriangles) {
  constexpr double r = 5;
  const std::array<double, 4> area = {std::numbers::pi * r * r, 4 * r * r, 2 * 1.3 * r * 1.3 * r,
                                      1.2 * r * 2.2 * r},
                              border = {2 * std::numbers::pi * r, 8 * r,
                                        4 * 1.3 * std::numbers::sqrt2 * r,
                                        2.4 * r + 2 * std::hypot(1.2 * r, 2.2 * r)};
  Plot plot = plot_of({{0, 0}, {10, 10}});
  plot.series.resize(5);
  plot.series[4] = plot.series[0];  // a disc again
  plot.series[0].points.clear();
  for (std::size_t i = 0; i < area.size(); ++i) {
    Plot marked = plot;
    marked.series[i].markers = true;
    marked.series[i].points = {{4.7, 4.7}};  // between the grid's lines
    const LdrPicture empty = drawn(plot), picture = drawn(marked);
    const auto at = plot_position(marked, {4.7, 4.7});
    const auto ink = colour_at(picture, at[0], at[1]);
    // OpenCV's blurred edges cover 1/2 to 9/10 px more all around.
    const double covered = covered_px(picture, empty, ink);
    EXPECT_GT(covered, area[i] + 0.5 * border[i]) << i;
    EXPECT_LT(covered, area[i] + 0.9 * border[i]) << i;
  }
}

TEST(Plot, ColoursAreThosePeopleOfAllKindsOfVisionTellApart) {
  // Okabe & Ito 2008: blue, vermilion, bluish green, reddish purple, orange, sky blue, black.
  const std::vector<std::array<int, 3>> expected = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                                                    {204, 121, 167}, {230, 159, 0}, {86, 180, 233},
                                                    {0, 0, 0}};
  Plot plot{"Title", "x", "y"};
  for (int i = 0; i < 7; ++i) plot.series.push_back({"", {{double(i), double(i)}}, false, true});
  const LdrPicture picture = drawn(plot);
  for (int i = 0; i < 7; ++i) {
    const auto at = plot_position(plot, {double(i), double(i)});
    EXPECT_EQ(colour_at(picture, at[0], at[1]), expected[static_cast<std::size_t>(i)]) << i;
  }
}

TEST(Plot, EverySeriesHasItsColourAndLegendLine) {
  Plot plot = plot_of({{0, 0}, {10, 10}});
  plot.series.push_back({"", {{5, 5}}, false, true});
  const LdrPicture nameless = drawn(plot);
  const auto at = plot_position(plot, {5, 5});
  EXPECT_EQ(colour_at(nameless, at[0], at[1]), vermilion);
  plot.series[0].name = "first";
  const LdrPicture one = drawn(plot);
  plot.series[1].name = "other";
  const LdrPicture two = drawn(plot);
  EXPECT_GT(changed(one, nameless, 900, 50, 1000, 80), 50);
  EXPECT_GT(changed(one, two, 900, 80, 1000, 110), 50);
  EXPECT_EQ(changed(one, two, 0, 0, 1000, 50), 0);
}

TEST(Plot, TextsChangeTheirOwnAreas) {
  const Plot plot = plot_of({{0, 0}, {10, 10}});
  const LdrPicture before = drawn(plot);
  const auto expect_change_in = [&](const Plot& other, int x0, int y0, int x1, int y1) {
    const LdrPicture after = drawn(other);
    EXPECT_GT(changed(before, after, x0, y0, x1, y1), 20);
    EXPECT_EQ(changed(before, after, x0, y0, x1, y1), changed(before, after, 0, 0, 1000, 640));
  };
  Plot titled = plot, x_labelled = plot, y_labelled = plot, labelled = plot;
  titled.title = "Another " + std::string(200, 'W');  // wider than the picture: made to fit
  x_labelled.x_label = "focus distance, m";
  y_labelled.y_label = "PSNR, dB";
  labelled.series[0].points[0].label = "9x9";
  expect_change_in(titled, 10, 5, 990, 50);
  expect_change_in(x_labelled, 200, 600, 900, 640);
  expect_change_in(y_labelled, 0, 56, 36, 570);
  expect_change_in(labelled, 60, 540, 140, 570);
  EXPECT_EQ(colour_at(before, 5, 5), white);
}

TEST(Plot, LabelsKeepClearOfEachOtherAndOfTheBorder) {
  Plot plot = plot_of({{0, 0}, {10, 10}});
  plot.series[0].points[1].label = "corner";
  const auto corner = plot_position(plot, {10, 10});
  const LdrPicture a = drawn(plot), none = drawn(plot_of({{0, 0}, {10, 10}}));
  // To the left of the last point and below it.
  EXPECT_EQ(changed(a, none, int(corner[0]), 0, 1000, 640), 0);
  EXPECT_GT(changed(a, none, 0, int(corner[1]), int(corner[0]), 640), 20);
  // Both labels of one point are there, on different sides of it.
  plot = plot_of({{0, 0}, {5, 5, "one"}, {5, 5, "two"}, {10, 10}});
  const auto middle = plot_position(plot, {5, 5});
  const int x = int(middle[0]), y = int(middle[1]);
  const LdrPicture both = drawn(plot), unlabelled = drawn(plot_of({{0, 0}, {5, 5}, {10, 10}}));
  EXPECT_GT(changed(both, unlabelled, x + 8, y - 20, x + 50, y), 20);
  EXPECT_GT(changed(both, unlabelled, x - 50, y - 20, x - 8, y), 20);
  // So are those of more than four at one place.
  std::vector<PlotPoint> points{{0, 0}, {5, 5, "label"}, {10, 10}};
  const int one = changed(drawn(plot_of(points)), unlabelled, 0, 0, 1000, 640);
  for (int i = 0; i < 5; ++i) {
    const LdrPicture before = drawn(plot_of(points));
    points.push_back({5, 5, "label"});
    EXPECT_GE(changed(drawn(plot_of(points)), before, 0, 0, 1000, 640), one) << i;
  }
  // A line is not written over: its point's label goes to the other side.
  plot = plot_of({{0, 0}, {5, 5, "one"}, {10, 10}});
  plot.series[0].lines = true;
  const LdrPicture line = drawn(plot);
  plot.series[0].points[1].label = "";
  EXPECT_EQ(changed(line, drawn(plot), x + 8, y - 20, x + 50, y), 0);
}

TEST(Plot, RefusesWhatCannotBeDrawn) {
  const Folder folder;
  const auto refuse = [&](Plot plot, const std::vector<std::string>& words) {
    expect_error(ErrorKind::usage, words, [&] { write_plot(folder / "plot.png", plot); });
    EXPECT_FALSE(std::filesystem::exists(folder / "plot.png"));
  };
  refuse({"Empty", "x", "y"}, {"no points"});
  refuse(plot_of({}), {"no points"});
  refuse(plot_of({{0, NAN}}), {"'y'", "nan", "finite"});
  refuse(plot_of({{-INFINITY, 0}}), {"'x'", "-inf"});
  refuse(plot_of({{1e101, 0}}), {"1e+101", "1e+100"});
  Plot plot = plot_of({{1, 1}, {0, 1}});
  plot.x_log = true;
  refuse(plot, {"'x' is logarithmic", "0 cannot"});
  plot = plot_of({{1, 1}, {1, -2}});
  plot.y_log = true;
  refuse(plot, {"'y' is logarithmic", "-2 cannot"});
  expect_error(ErrorKind::usage, {"PNG or JPEG"}, [&] {
    write_plot(folder / "plot.exr", plot_of({{1, 1}}));
  });
  expect_error(ErrorKind::output, {"none"}, [&] {
    write_plot(folder / "none/plot.png", plot_of({{1, 1}}));
  });
}

std::vector<std::string> labels(const std::vector<double>& values, bool is_log) {
  const Axis axis("x", values, is_log);
  std::vector<std::string> all;
  for (const double tick : axis.ticks()) all.push_back(axis.label(tick));
  return all;
}

using Labels = std::vector<std::string>;

TEST(Axis, TicksAreRoundNumbersAroundTheData) {
  EXPECT_EQ(labels({0.3, 4}, false), (Labels{"0", "0.5", "1", "1.5", "2", "2.5", "3", "3.5", "4"}));
  EXPECT_EQ(labels({-0.1, 0.3}, false),
            (Labels{"-0.1", "-0.05", "0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.3"}));
  EXPECT_EQ(labels({3, 40}, true), (Labels{"2", "5", "10", "20", "50"}));
  EXPECT_EQ(labels({2e-5, 1}, true), (Labels{"1e-05", "0.0001", "0.001", "0.01", "0.1", "1"}));
  EXPECT_EQ(labels({1e5, 1e17}, true),
            (Labels{"10000", "1e+06", "1e+08", "1e+10", "1e+12", "1e+14", "1e+16", "1e+18"}));
  EXPECT_EQ(labels({1000000, 1000004}, false)[1], "1000000.5");
}

TEST(Axis, OneValueOrHugeRangesStillHaveAFewTicks) {
  for (const bool is_log : {false, true}) {
    for (const std::vector<double>& values : std::vector<std::vector<double>>{
             {7}, {1, 1 + 1e-15}, {1e-100, 1e100}, {1e-90, 2e-90}, {0.1, 0.3}}) {
      const Axis axis("x", values, is_log);
      EXPECT_GE(axis.ticks().size(), 2u);
      EXPECT_LE(axis.ticks().size(), 25u);
      for (const double value : values) {
        EXPECT_GE(axis.share(value), -1e-8);
        EXPECT_LE(axis.share(value), 1 + 1e-8);
      }
    }
  }
  EXPECT_EQ(Axis("x", {0}, false).share(0), 0.5);
}

}  // namespace
}  // namespace defray::test::plot_test
