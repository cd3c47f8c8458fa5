// The points around points.
#include <gtest/gtest.h>

#include <algorithm>

#include "splat/surfels/coarser.h"

namespace defray::test::neighbours_test {
namespace {

constexpr std::size_t most = 20;
using Places = std::vector<std::array<float, 3>>;

/// A square of 10 by 10 units, the right half with points `finer` times as near to each other.
Places halves(int finer) {
  Places places;
  for (const int half : {0, 1}) {
    const int times = half == 0 ? 1 : finer;
    for (int i = 0; i < 5 * times; ++i) {
      for (int j = 0; j < 10 * times; ++j) {
        places.push_back({5 * float(half) + (float(i) + 0.5f) / float(times),
                          (float(j) + 0.5f) / float(times), 0});
      }
    }
  }
  return places;
}

TEST(Neighbours, AreTheNearestInOrder) {
  const Places places = halves(1);
  Neighbours around(places, most);
  add_coarser(places, around);
  const auto square = [&](std::size_t a, std::size_t b) {
    const float x = places[a][0] - places[b][0], y = places[a][1] - places[b][1];
    return x * x + y * y;
  };
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    std::vector<std::pair<float, std::uint32_t>> all;
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      if (k != i) all.emplace_back(square(i, k), k);
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(around.of(i).size(), most);
    for (std::size_t k = 0; k < most; ++k) EXPECT_EQ(square(i, around.of(i)[k]), all[k].first);
    EXPECT_TRUE(around.coarser(i).empty()) << "of an even square, at its edges as well";
  }
  EXPECT_EQ(Neighbours({{0, 0, 0}, {1, 0, 0}}, most).of(0).size(), 1u);
}

/// The last row before finer ones has these alone nearest to it.
TEST(Neighbours, OfTheLastRowBeforeFinerPointsAreTheCoarserOnesToo) {
  const Places places = halves(8);
  Neighbours around(places, most);
  add_coarser(places, around);
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const auto coarser = around.coarser(i);
    if (places[i][0] != 4.5f) {
      if (places[i][0] < 3) EXPECT_TRUE(coarser.empty()) << places[i][0];
      continue;
    }
    ASSERT_FALSE(coarser.empty()) << places[i][1];
    EXPECT_LE(coarser.size(), most / 2);
    EXPECT_EQ(places[coarser.front()][0], 3.5f);
    EXPECT_EQ(places[coarser.front()][1], places[i][1]) << "the nearest first";
    for (const std::uint32_t other : coarser) EXPECT_LT(places[other][0], 4.5f);
    EXPECT_GT(places[around.of(i).front()][0], 5.0f);
    const auto all = around.of(i);
    std::vector<std::uint32_t> sorted(all.begin(), all.end());
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "each once";
  }
}

}  // namespace
}  // namespace defray::test::neighbours_test
