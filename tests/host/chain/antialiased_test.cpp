// Where depth was anti-aliased, by what `repair` says of its pixels.
#include "chain/steps/antialiased.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/plane.h"
#include "kernels/params.h"

namespace defray::test::antialiased_test {
namespace {

constexpr int width = 700, height = 300;
constexpr std::uint32_t own = 13, mean = own | DEFRAY_RAMP_MIXES;

/// Every tenth pixel of every second row lies between two surfaces, and is as `colour` says.
std::vector<std::uint32_t> ramps_of(const std::function<std::uint32_t(int x, int y)>& colour) {
  std::vector<std::uint32_t> ramps(size(width) * size(height));
  for (int y = 0; y < height; y += 2) {
    for (int x = 0; x < width; x += 10) ramps[size(y * width + x)] = colour(x, y);
  }
  return ramps;
}

constexpr std::size_t ramps_in_all = std::size_t{width / 10} * (height / 2);

Antialiased decided(const std::vector<std::uint32_t>& ramps, std::size_t mixed, int rows = height) {
  Antialiased a(width, height);
  for (int y = 0; y < height; y += rows) a.add({y, std::min(height, y + rows)}, ramps);
  a.decide(mixed);
  return a;
}

/// In a frame so small that all its pixels count together, and in a large one.
TEST(Antialiased, SixInTenMeansAreEnoughAndOneRampInTwentyMixedPixels) {
  constexpr std::size_t count = 100;
  for (const std::size_t means : {0, 59, 60, 100}) {
    std::vector<std::uint32_t> ramps(100 * 40);
    for (std::size_t i = 0; i < count; ++i) ramps[i * 37] = i < means ? mean : own;
    for (const bool is_enough : {true, false}) {
      Antialiased a(100, 40);
      a.add({0, 40}, ramps);
      a.decide(20 * count + (is_enough ? 0 : 1));
      const bool is_smooth = means >= 60 && is_enough;
      EXPECT_EQ(a.pixels(), is_smooth ? count : 0) << means;
      EXPECT_EQ(a.is_at(99, 39), is_smooth) << means;
    }
  }
  const auto mostly = [](int of_ten) {
    return ramps_of([=](int x, int y) { return (x / 10 + 3 * y / 2) % 10 < of_ten ? mean : own; });
  };
  EXPECT_EQ(decided(mostly(5), ramps_in_all).pixels(), 0u);
  EXPECT_EQ(decided(mostly(7), ramps_in_all).pixels(), ramps_in_all);
}

TEST(Antialiased, HalvesOfAFrameAreToldApart) {
  const Antialiased a =
      decided(ramps_of([](int x, int) { return x < width / 2 ? mean : own; }), ramps_in_all);
  const Antialiased below =
      decided(ramps_of([](int, int y) { return y < height / 2 ? mean : own; }), ramps_in_all);
  for (int i = 0; i < height; i += 7) {
    EXPECT_TRUE(a.is_at(10, size(i)));
    EXPECT_TRUE(a.is_at(200, size(i)));
    EXPECT_FALSE(a.is_at(500, size(i)));
    EXPECT_FALSE(a.is_at(width - 1, size(i)));
  }
  EXPECT_TRUE(below.is_at(300, 0));
  EXPECT_FALSE(below.is_at(300, height - 1));
}

/// Few pixels of a place are judged by the whole frame, many by themselves.
TEST(Antialiased, FewPixelsAreAsTheFrameIs) {
  const auto with_corner = [](int side) {
    return ramps_of(
        [&](int x, int y) { return x >= width - side && y >= height - side ? own : mean; });
  };
  EXPECT_EQ(decided(with_corner(20), ramps_in_all).pixels(), ramps_in_all);
  EXPECT_FALSE(decided(with_corner(200), ramps_in_all).is_at(width - 1, height - 1));
  EXPECT_TRUE(decided(with_corner(200), ramps_in_all).is_at(0, 0));
}

TEST(Antialiased, BandsAndNothingToDecide) {
  const auto ramps = ramps_of([](int x, int y) { return x + y < 400 ? mean : own; });
  const Antialiased whole = decided(ramps, ramps_in_all);
  for (const int rows : {16, 48, 208}) {
    const Antialiased bands = decided(ramps, ramps_in_all, rows);
    EXPECT_EQ(bands.pixels(), whole.pixels());
    for (int x = 0; x < width; x += 50) {
      EXPECT_EQ(bands.is_at(size(x), 100), whole.is_at(size(x), 100));
    }
  }
  EXPECT_GT(whole.pixels(), 0u);
  EXPECT_LT(whole.pixels(), ramps_in_all);
  const std::vector<std::uint32_t> none(size(width) * size(height));
  EXPECT_FALSE(decided(none, 0).is_at(0, 0));
  EXPECT_EQ(decided(none, 10).pixels(), 0u);
}

}  // namespace
}  // namespace defray::test::antialiased_test
