// Where texts and lines of a chart stand: by their ticks, in the middle of what they name, apart.
#include <cmath>
#include <functional>
#include <numeric>

#include "image/ldr.h"
#include "measure/plot.h"
#include "measure/plot_axis.h"
#include "support.h"

namespace defray::test::plot_layout_test {
namespace {

/// What is drawn in a rectangle.
struct Ink {
  int left = 9999, top = 9999, right = -1, bottom = -1;
  bool is_empty() const { return right < 0; }
  double x() const { return (left + right) / 2.0; }
  double y() const { return (top + bottom) / 2.0; }
};

class PlotLayout : public testing::Test {
 protected:
  PlotLayout() {
    plot_.series.push_back({"one", {{0, 0}, {10, 4}}, true, true});
    plot_.series.push_back({"", {{2, 1}}, false, true});
    plot_.series.push_back({"three", {{4, 1}}, true, true});
    draw();
    const auto low = plot_position(plot_, {0, 0}), high = plot_position(plot_, {10, 4});
    left_ = std::lround(low[0]), bottom_ = std::lround(low[1]);
    right_ = std::lround(high[0]), top_ = std::lround(high[1]);
  }

  void draw() {
    write_plot(folder_ / "plot.png", plot_);
    picture_ = read_ldr(folder_ / "plot.png", Content::data);
  }

  std::array<long, 3> colour(int x, int y) const {
    const std::size_t i = size(y) * size(picture_.width) + size(x);
    return {std::lround(255 * picture_.planes[0][i]), std::lround(255 * picture_.planes[1][i]),
            std::lround(255 * picture_.planes[2][i])};
  }

  /// Of what `counts`, in columns x0 up to x1 and rows y0 up to y1.
  template <typename Counts>
  Ink ink(int x0, int y0, int x1, int y1, const Counts& counts) const {
    Ink box;
    for (int y = std::max(0, y0); y < std::min(y1, plot_height_px); ++y) {
      for (int x = std::max(0, x0); x < std::min(x1, plot_width_px); ++x) {
        if (!counts(colour(x, y))) continue;
        box.left = std::min(box.left, x), box.right = std::max(box.right, x);
        box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y);
      }
    }
    return box;
  }
  Ink text(int x0, int y0, int x1, int y1) const {
    return ink(x0, y0, x1, y1, [](const auto& c) { return c[0] < 128 && c[0] == c[2]; });
  }

  Folder folder_;
  Plot plot_{"A title", "the x axis", "the y axis"};
  LdrPicture picture_;
  int left_, right_, top_, bottom_;
};

TEST_F(PlotLayout, TickLinesCrossTheAxesAreaAndTheirNamesStandBesideThem) {
  const Axis x_axis("x", {0, 10}, false), y_axis("y", {0, 4}, false);
  const auto is_drawn = [](const auto& c) { return c[0] < 250; };
  for (const double tick : x_axis.ticks()) {
    const int x = static_cast<int>(std::lround(plot_position(plot_, {tick, 0})[0]));
    // Clear of the series in the lower right corner and of lines across.
    const Ink line = ink(x - 1, bottom_ - 12, x + 2, bottom_ - 2, is_drawn);
    EXPECT_TRUE(line.top <= bottom_ - 12 && line.bottom >= bottom_ - 3) << tick;
    const Ink name = text(x - 25, bottom_ + 7, x + 26, bottom_ + 30);
    EXPECT_NEAR(name.x(), x, 2) << tick;
    EXPECT_GT(name.bottom - name.top, 6);
    EXPECT_LT(name.bottom, bottom_ + 26);
  }
  EXPECT_TRUE(ink(left_ + 30, bottom_ - 12, left_ + 40, bottom_ - 2, is_drawn).is_empty());
  for (const double tick : y_axis.ticks()) {
    const int y = static_cast<int>(std::lround(plot_position(plot_, {0, tick})[1]));
    const Ink line = ink(right_ - 14, y - 1, right_ - 2, y + 2, is_drawn);
    EXPECT_TRUE(tick == 4 || (line.left <= right_ - 14 && line.right >= right_ - 3)) << tick;
    const Ink name = text(left_ - 42, y - 12, left_ - 7, y + 13);
    EXPECT_NEAR(name.y(), y, 2) << tick;
    EXPECT_NEAR(left_ - name.right, 10, 4) << tick;
  }
}

TEST_F(PlotLayout, TitlesStandInTheMiddleOfWhatTheyName) {
  const Ink title = text(0, 0, plot_width_px, top_ - 8);
  EXPECT_NEAR(title.x(), plot_width_px / 2.0, 4);
  EXPECT_GT(title.top, 4);
  const Ink x_name = text(0, bottom_ + 30, plot_width_px, plot_height_px);
  EXPECT_NEAR(x_name.x(), (left_ + right_) / 2.0, 4);
  EXPECT_LT(x_name.bottom, plot_height_px - 4);
  EXPECT_GT(x_name.top, bottom_ + 30);
  const Ink y_name = text(0, 0, 32, plot_height_px);
  EXPECT_NEAR(y_name.y(), (top_ + bottom_) / 2.0, 4);
  EXPECT_GT(y_name.bottom - y_name.top, 3 * (y_name.right - y_name.left));  // upright
  EXPECT_GT(y_name.left, 2);
  EXPECT_LT(y_name.right, 30);
}

TEST_F(PlotLayout, FourSeriesHaveMarkersOfTheirOwn) {
  plot_.series = {{"", {{0, 0}, {10, 4}}, false, false}};
  for (int i = 0; i < 5; ++i) plot_.series.push_back({"", {{1.5 + i, 1.5}}, false, true});
  draw();
  std::vector<std::vector<bool>> shapes;
  for (int i = 0; i < 5; ++i) {
    const auto at = plot_position(plot_, {1.5 + i, 1.5});
    std::vector<bool>& shape = shapes.emplace_back();
    for (int y = -10; y <= 10; ++y) {
      for (int x = -10; x <= 10; ++x) {
        const auto c = colour(static_cast<int>(std::lround(at[0])) + x,
                              static_cast<int>(std::lround(at[1])) + y);
        shape.push_back(std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 60);
      }
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto apart = std::inner_product(shapes[i].begin(), shapes[i].end(), shapes[k].begin(),
                                            0, std::plus<>(), std::not_equal_to<>());
      EXPECT_GT(apart, 12) << i << " " << k;
    }
  }
}

TEST_F(PlotLayout, LongTitlesAreAsSmallAsTheyMustBe) {
  plot_.title = std::string(150, 'W');
  plot_.x_label = std::string(120, 'W');
  draw();
  const Ink title = text(0, 0, plot_width_px, top_ - 8);
  EXPECT_NEAR(title.right - title.left, plot_width_px - 40, 12);
  const Ink x_name = text(0, bottom_ + 30, plot_width_px, plot_height_px);
  EXPECT_NEAR(x_name.right - x_name.left, right_ - left_, 12);
}

TEST_F(PlotLayout, TheYAxissNameLeavesRoomForLongTicks) {
  plot_.series = {{"", {{0, 1000000}, {10, 1000004}}, true, true}};
  draw();
  const auto low = plot_position(plot_, {0, 1000000}), high = plot_position(plot_, {10, 1000004});
  const Axis axis("y", {1000000, 1000004}, false);
  for (const double tick : axis.ticks()) {
    const int y = static_cast<int>(std::lround(plot_position(plot_, {0, tick})[1]));
    const Ink name = text(33, y - 8, static_cast<int>(low[0]) - 4, y + 9);
    const bool is_longest = axis.label(tick).size() == 9;  // 1000000.5
    EXPECT_TRUE(!is_longest || name.left < 46) << tick << " " << name.left;
    EXPECT_NEAR(low[0] - name.right, 10, 4) << tick;
  }
  // Beside its letters there is nothing.
  const auto is_drawn = [](const auto& c) { return c != std::array<long, 3>{255, 255, 255}; };
  EXPECT_TRUE(ink(0, 0, 36, static_cast<int>(high[1]) + 60, is_drawn).is_empty());
}

TEST_F(PlotLayout, TheLegendIsAsWideAsItsNamesUpToAThird) {
  const auto legend = [&] {
    draw();
    right_ = static_cast<int>(std::lround(plot_position(plot_, {10, 4})[0]));
    return text(right_ + 45, top_ - 2, plot_width_px, top_ + 40);
  };
  plot_.series[0].name = std::string(20, 'n');
  EXPECT_NEAR(plot_width_px - legend().right, 32, 6);
  const int is_short = right_;
  plot_.series[0].name = std::string(80, 'n');  // made to fit
  const Ink name = legend();
  EXPECT_LT(name.right, plot_width_px - 8);
  EXPECT_GT(name.right - name.left, 240);
  EXPECT_LT(right_, is_short);
  EXPECT_NEAR(plot_width_px - right_, 350, 6);
}

TEST_F(PlotLayout, TheLegendHasALineASeriesWithAName) {
  const auto has = [](std::array<long, 3> wanted) {
    return [=](const std::array<long, 3>& c) { return c == wanted; };
  };
  const Ink one = ink(right_ + 8, 0, plot_width_px, plot_height_px, has({0, 114, 178}));
  const Ink unnamed = ink(right_ + 8, 0, plot_width_px, plot_height_px, has({213, 94, 0}));
  const Ink three = ink(right_ + 8, 0, plot_width_px, plot_height_px, has({0, 158, 115}));
  EXPECT_TRUE(unnamed.is_empty());
  EXPECT_GT(one.left, right_ + 10);
  EXPECT_NEAR(one.right - one.left, 24, 2);
  EXPECT_EQ(one.left, three.left);
  EXPECT_GT(three.top, one.bottom + 8);
  for (const Ink& sign : {one, three}) {
    const Ink name = text(sign.right + 2, sign.top - 6, plot_width_px, sign.bottom + 7);
    EXPECT_NEAR(name.y(), sign.y(), 3);
    EXPECT_NEAR(name.left, sign.right + 8, 4);
    EXPECT_LT(name.right, plot_width_px - 4);
  }
}

}  // namespace
}  // namespace defray::test::plot_layout_test
