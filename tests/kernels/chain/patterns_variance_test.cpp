// What colours around hidden cells vary by, against its definition, pixel by pixel.
#include <algorithm>
#include <array>
#include <cmath>

#include "chain/patterns/patterns_cells.h"
#include "kernels/chain/patterns_scene.h"

namespace defray::test::patterns_variance_test {
namespace {

constexpr Size frame_size{110, 150};
constexpr int units = 7;  // of 4 cells, a row

/// A wall with a bar before it, 20 px wide, and one by the right border.
template <typename Wall>
PatternScene scene(const Wall& wall) {
  PatternScene s(frame_size);
  s.paint(wall,
          [](int x, int y) { return ((x >= 40 && x < 60) || (x >= 96 && x < 104)) && y < 130; });
  return s;
}

struct Definition {
  const PatternScene& s;
  const PatternSettings& settings;
  Words words = s.words();

  bool has(int x, int y) const {
    return x < frame_size.width && y < frame_size.height &&
           (words[s.at(x, y)] & DEFRAY_PATTERN_KNOWN) != 0;
  }
  int colour(int x, int y, int c) const {
    return static_cast<int>(words[s.at(x, y)] >> (8 * c) & 255);
  }

  double of_cell(int cell_x, int cell_y) const {
    const int n = settings.window_cells;
    double count = 0, squares = 0, apart[4] = {}, pairs[4] = {};
    std::array<double, 3> sum{};
    int cells_away = n;
    for (int y = 0; y < frame_size.height; ++y) {
      for (int x = 0; x < frame_size.width; ++x) {
        const int across = std::abs(x / 4 - cell_x), down = std::abs(y / 4 - cell_y);
        if (!has(x, y) || s.coc[s.at(x, y)] != 512 || across >= n || down >= n) continue;
        const double w = (n - across) * (n - down);
        cells_away = std::min(cells_away, std::max(across, down));
        count += w;
        for (int c = 0; c < 3; ++c) {
          sum[size(c)] += w * colour(x, y, c);
          squares += w * colour(x, y, c) * colour(x, y, c);
        }
        for (int k = 0; k < 4; ++k) {
          const int lag = 2 << k;
          for (const auto& [tx, ty] : {std::pair{x + lag, y}, {x, y + lag}}) {
            if (!has(tx, ty) || s.coc[s.at(tx, ty)] != 512) continue;
            pairs[k] += w;
            for (int c = 0; c < 3; ++c) {
              apart[k] += w * std::pow(colour(x, y, c) - colour(tx, ty, c), 2);
            }
          }
        }
      }
    }
    if (count == 0) return 0;
    const double variance =
        squares / count - (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (count * count);
    const int k = cells_away < 2 ? cells_away : cells_away < 4 ? 2 : 3;
    return std::min(variance, 1.25 * apart[k] / pairs[k]);
  }
};

void expect_definition(const PatternScene& s, int window_cells) {
  PatternSettings settings;
  settings.window_cells = window_cells;
  const Definition definition{s, settings};
  const Values<float> variance =
      patterns_variance(s.frame(), s.hidden(), definition.words, settings);
  for (int cell_y : {0, 7, 31, 32}) {
    for (const int cell_x : {10, 11, 12, 13, 14, 24, 25}) {
      const float found = variance[size(cell_y * 4 * units + cell_x)];
      if (cell_y == 32 && !s.is_behind[s.at(4 * cell_x, 4 * cell_y)]) continue;
      const double expected = definition.of_cell(cell_x, cell_y);
      EXPECT_NEAR(found, expected, 1e-6 * expected) << cell_x << " " << cell_y;
    }
  }
  EXPECT_EQ(variance[size(7 * 4 * units + 9)], 0);  // hides nothing
}

TEST(PatternVariance, IsThatOfNoise) { expect_definition(scene(noise), 3); }

TEST(PatternVariance, IsNoMoreThanPixelsDifferWhereTheNearestKnownOneIs) {
  const PatternScene s = scene([](int x, int y, int) { return 0.004f * x + 0.002f * y; });
  for (const int n : {3, 4, 6}) expect_definition(s, n);
}

TEST(PatternVariance, IsOfTheHiddenSurfaceAlone) {
  PatternScene s = scene([](int x, int y, int c) {
    return x % 8 < 4 ? noise(x, y, c) : 0.5f + 0.5f * noise(y, x, c);
  });
  for (int y = 0; y < frame_size.height; ++y) {
    for (int x = 0; x < frame_size.width; ++x) {
      const bool is_other = x % 8 >= 4 || (x % 8 == 1 && y % 3 == 0);  // also within cells
      if (!s.is_behind[s.at(x, y)] && is_other) s.coc[s.at(x, y)] = 512 + 257;
    }
  }
  expect_definition(s, 3);
  // A third surface in the cells is of neither.
  PatternScene third = s;
  for (int y = 0; y < frame_size.height; y += 5) third.coc[third.at(3, y)] = -9000;
  expect_definition(third, 3);
}

TEST(PatternVariance, NothingKnownIsNone) {
  const PatternScene s = scene(noise);
  const Values<float> variance = patterns_variance(
      s.frame(), s.hidden(), Words(s.pixels(), DEFRAY_PATTERN_BEHIND), PatternSettings());
  EXPECT_EQ(variance, Plane(variance.size()));
}

}  // namespace
}  // namespace defray::test::patterns_variance_test
