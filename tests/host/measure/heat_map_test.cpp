// A heat map's cells: their colours, their texts, and the frame around the smallest.
#include "measure/heat_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/ldr.h"
#include "support.h"

namespace defray::test::heat_map_test {
namespace {

constexpr int cell_width = 76, cell_height = 40, left = 70, top = 84;

class HeatMapPicture : public testing::Test {
 protected:
  Folder folder;
  HeatMap map{"title", "x", "y", {"1", "2", "4"}, {"1", "2"}, {4, 8, 16, 2, {}, 32}};

  LdrPicture drawn() {
    write_heat_map(folder / "map.png", map);
    return read_ldr(folder / "map.png", Content::data);
  }
  /// R + G + B, 0 to 3, near the left upper corner of a cell, inside its frame.
  static double brightness(const LdrPicture& p, int column, int row) {
    const std::size_t i =
        size(top + row * cell_height + 6) * size(p.width) + size(left + column * cell_width + 6);
    return static_cast<double>(p.planes[0][i] + p.planes[1][i] + p.planes[2][i]);
  }
  /// Of pixels of another colour than a cell's, inside its frame, the columns from its left edge
  /// on.
  static std::vector<int> ink(const LdrPicture& p, int column, int row) {
    const int x0 = left + column * cell_width, y0 = top + row * cell_height;
    const double ground = brightness(p, column, row);
    std::vector<int> columns;
    for (int y = y0 + 5; y < y0 + cell_height - 5; ++y) {
      for (int x = 5; x < cell_width - 5; ++x) {
        const std::size_t i = size(y) * size(p.width) + size(x0 + x);
        const double here = static_cast<double>(p.planes[0][i] + p.planes[1][i] + p.planes[2][i]);
        if (std::abs(here - ground) > 0.2) columns.push_back(x);
      }
    }
    return columns;
  }
  /// Whether the cell's edge is of the frame's red.
  static bool is_framed(const LdrPicture& p, int column, int row) {
    const std::size_t i = size(top + row * cell_height) * size(p.width) +
                          size(left + column * cell_width + cell_width / 2);
    return p.planes[0][i] > 0.8f && p.planes[1][i] < 0.1f && p.planes[2][i] < 0.1f;
  }
};

TEST_F(HeatMapPicture, IsLighterTheSmallerTheValue) {
  const LdrPicture p = drawn();
  EXPECT_EQ(p.width, left + 3 * cell_width + 20);
  EXPECT_EQ(p.height, top + 2 * cell_height + 40);
  EXPECT_GT(brightness(p, 0, 1), brightness(p, 0, 0) + 0.1);  // 2, 4
  EXPECT_GT(brightness(p, 0, 0), brightness(p, 1, 0) + 0.1);  // 8
  EXPECT_GT(brightness(p, 1, 0), brightness(p, 2, 0) + 0.1);  // 16
  EXPECT_GT(brightness(p, 2, 0), brightness(p, 2, 1) + 0.1);  // 32
  EXPECT_DOUBLE_EQ(brightness(p, 1, 1), 3);                   // not measured: white
}

TEST_F(HeatMapPicture, LabelsAreBlackOnWhite) {
  const LdrPicture p = drawn();
  float darkest = 1;
  for (std::size_t i = 0; i < size(top) * size(p.width); ++i) {
    darkest = std::min(darkest, p.planes[0][i]);
    ASSERT_EQ(p.planes[1][i], p.planes[0][i]);
    ASSERT_EQ(p.planes[2][i], p.planes[0][i]);
  }
  EXPECT_LT(darkest, 0.02f);  // thin lines
  EXPECT_EQ(p.planes[0][0], 1);
}

TEST_F(HeatMapPicture, FramesTheSmallestAlone) {
  const LdrPicture p = drawn();
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_EQ(is_framed(p, column, row), column == 0 && row == 1) << column << " " << row;
    }
  }
}

TEST_F(HeatMapPicture, WritesEachValueIntoItsCell) {
  const LdrPicture p = drawn();
  EXPECT_TRUE(ink(p, 1, 1).empty());
  EXPECT_GT(ink(p, 0, 0).size(), 10u);
  EXPECT_GT(ink(p, 2, 0).size(), ink(p, 1, 0).size());  // "16" is wider than "8"
  // In its middle, but for what a digit is wider on one side.
  const std::vector<int> eight = ink(p, 1, 0);
  const auto [first, last] = std::minmax_element(eight.begin(), eight.end());
  EXPECT_NEAR((*first + *last) / 2.0, cell_width / 2.0, 2);
}

TEST_F(HeatMapPicture, OfOneValueIsLight) {
  map = {"title", "x", "y", {"1"}, {"1"}, {3}};
  const LdrPicture p = drawn();
  EXPECT_GT(brightness(p, 0, 0), 1.5);
  EXPECT_TRUE(is_framed(p, 0, 0));
}

TEST_F(HeatMapPicture, RefusesWhatItCannotDraw) {
  const auto refuses = [&](const std::vector<std::string>& words,
                           std::vector<std::optional<double>> values,
                           const std::string& file = "map.png") {
    map.values = std::move(values);
    expect_error(ErrorKind::usage, words, [&] { write_heat_map(folder / file, map); });
    EXPECT_FALSE(std::filesystem::exists(folder / file));
  };
  refuses({"title", "5 values", "6 cells"}, {1, 2, 3, 4, 5});
  refuses({"nothing was measured"}, std::vector<std::optional<double>>(6));
  refuses({"a value is 0"}, {0, 1, 2, 3, 4, 5});
  refuses({"a value is -1"}, {1, 1, 2, 3, 4, -1});
  refuses({"a value is nan"}, {1, 1, 2, NAN, 4, 5});
  refuses({"a value is inf"}, {1, 1, 2, HUGE_VAL, 4, 5});
  refuses({"PNG or JPEG"}, {1, 1, 2, 3, 4, 5}, "map.exr");
}

}  // namespace
}  // namespace defray::test::heat_map_test
