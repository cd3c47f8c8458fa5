// Bands of rows; that their seams do not show: 'defray validate', which runs every stage in the
// narrowest ones.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "frame/band_rows.h"

namespace defray::test::property_bands_test {
namespace {

RC_GTEST_PROP(Bands, CoverTheFrameOnceAndFitTheBudget, ()) {
  const int height = *rc::gen::inRange(1, 300), step = *rc::gen::element(1, 16);
  const std::int64_t reach = *rc::gen::inRange(0, 100);
  const auto row_bytes = static_cast<std::size_t>(*rc::gen::inRange(1, 1000));
  const auto memory = static_cast<std::size_t>(*rc::gen::inRange(0, 200000));
  int next = 0;
  for (const BandRows& b :
       cut_into_windows({0, height}, height, reach, step, {row_bytes}, memory)) {
    RC_ASSERT(b.y == next && b.rows > 0);
    next = b.y + b.rows;
    const int end = b.window_y + b.window_rows;
    RC_ASSERT(b.y % step == 0 && b.window_y % step == 0);
    RC_ASSERT(b.window_y == 0 || b.window_y <= b.y - reach);
    RC_ASSERT(end == height || end >= next + reach);
    RC_ASSERT(b.window_y >= 0 && end <= height);
    RC_ASSERT(b.rows <= step || static_cast<std::size_t>(b.window_rows) * row_bytes <= memory);
  }
  RC_ASSERT(next == height);
}

TEST(Bands, AFrameThatFitsIsOne) {
  const auto bands = cut_into_windows({0, 100}, 100, 10, 16, {8}, 100 * 8);
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_EQ(bands[0].window_rows, 100);
}

TEST(Bands, AReachBeyondAllFramesIsTheWholeFrame) {
  const auto bands = cut_into_windows({0, 100}, 100, std::int64_t{1} << 40, 1, {8}, 1);
  ASSERT_EQ(bands.size(), 100u);
  EXPECT_EQ(bands[50].window_y, 0);
  EXPECT_EQ(bands[50].window_rows, 100);
}

}  // namespace
}  // namespace defray::test::property_bands_test
