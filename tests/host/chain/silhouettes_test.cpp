// Silhouettes that go on behind what hides them.
#include "chain/silhouettes/silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "kernels/params.h"
#include "reference/twin_backend.h"

namespace defray::test::silhouettes_test {
namespace {

constexpr std::int32_t near = -5120, middle = 0, far = 2048;  // quanta; 256 are a pixel
constexpr int width = 160, height = 120;

Frame drawn(const std::function<std::int32_t(int x, int y)>& coc_at, int rows = height) {
  std::vector<std::int32_t> coc;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width; ++x) coc.push_back(coc_at(x, y));
  }
  return Frame{width, rows, std::move(coc)};
}

Words marks_of(const Frame& f) {
  Silhouettes all;
  continue_silhouettes(f, reference::TwinBackend().mixed(f), all);
  return all.marks;
}

bool is_marked(const Words& marks, int x, int y) {
  return marks[size(y * width + x)] & DEFRAY_SILHOUETTE;
}

std::size_t count_of(const Words& marks) {
  const auto is_silhouette = [](std::uint32_t mark) { return (mark & DEFRAY_SILHOUETTE) != 0; };
  return static_cast<std::size_t>(std::count_if(marks.begin(), marks.end(), is_silhouette));
}

/// Below a line through (80, 60), or above it, lies the middle surface; a near bar from column 70
/// on hides them, up to `end`.
Frame slope(double rise, int end, bool is_below = true) {
  return drawn([=](int x, int y) {
    if (x >= 70 && x < end) return near;
    return (y + 0.5 > 60 + rise * (x + 0.5 - 80)) == is_below ? middle : far;
  });
}

TEST(Silhouettes, GoOnStraightUntilWhatHidesThemEnds) {
  for (const double rise : {0.0, 0.25, -0.5, 1.0, -2.0}) {
    for (const bool is_below : {false, true}) {
      const Words marks = marks_of(slope(rise, 86, is_below));
      for (int x = 70; x < 86; ++x) {
        const int y = static_cast<int>(std::floor(60 + rise * (x + 0.5 - 80)));
        bool is_near = false;
        for (int d = -2; d <= 2; ++d) is_near |= is_marked(marks, x, y + d);
        EXPECT_TRUE(is_near) << rise << " at " << x;
        for (int d = 6; d < 20; ++d) {
          EXPECT_FALSE(is_marked(marks, x, y + d)) << rise << " at " << x;
          EXPECT_FALSE(is_marked(marks, x, y - d)) << rise << " at " << x;
        }
      }
    }
  }
}

/// No way from pixel to pixel, slanted ones either, passes from one side to the other.
TEST(Silhouettes, LetNothingThrough) {
  for (const double rise : {0.0, 0.3, -0.7, 1.0}) {
    const Frame f = slope(rise, 86);
    const Words marks = marks_of(f);
    std::vector<bool> seen(size(width) * size(height));
    std::vector<std::size_t> open{size(30 * width + 78)};
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      const bool is_hidden = x >= 70 && x < 86 && y >= 10 && y < height - 10;
      if (seen[i] || !is_hidden || is_marked(marks, x, y)) continue;
      seen[i] = true;
      for (int d = 0; d < 9; ++d) open.push_back(size((y + d / 3 - 1) * width + x + d % 3 - 1));
    }
    EXPECT_TRUE(seen[size(30 * width + 78)]);
    EXPECT_FALSE(seen[size(90 * width + 78)]) << rise;
  }
}

/// The lens looks (0 + 5120) / 256 + 2 px past the edge, or 64 where that is farther.
TEST(Silhouettes, GoOnAsFarAsTheLensLooks) {
  const Words marks = marks_of(slope(0, width));
  EXPECT_TRUE(is_marked(marks, 70 + 21, 60));
  EXPECT_FALSE(is_marked(marks, 70 + 23, 60));
  const Frame f = drawn([](int x, int y) { return x >= 70 ? 8 * near : y >= 60 ? middle : far; });
  const Words longest = marks_of(f);
  EXPECT_TRUE(is_marked(longest, 70 + 63, 60));
  EXPECT_FALSE(is_marked(longest, 70 + 65, 60));
}

TEST(Silhouettes, OfWhatIsAloneOrThinEndNowhere) {
  const auto coc_of = [](std::int32_t hider, std::int32_t thing, int last) {
    return drawn([=](int x, int y) { return x >= 70 ? hider : y >= 60 && y < last ? thing : far; });
  };
  EXPECT_GT(count_of(marks_of(coc_of(near, middle, 70))), 30u);
  EXPECT_EQ(count_of(marks_of(coc_of(near, far, 70))), 0u);
  EXPECT_EQ(count_of(marks_of(coc_of(near, near, 70))), 0u);
  EXPECT_EQ(count_of(marks_of(coc_of(near, middle, 66))), 0u);
  EXPECT_GT(count_of(marks_of(coc_of(near, middle, 67))), 30u);
  EXPECT_EQ(count_of(marks_of(coc_of(near, middle + far - 192, 70))), 0u);  // no jump
  EXPECT_GT(count_of(marks_of(coc_of(near, middle + far - 193, 70))), 30u);
}

/// An edge that is seen for less than six pixels says nothing of its direction.
TEST(Silhouettes, OfWhatIsHardlySeenEndNowhere) {
  for (const int seen : {5, 6}) {
    const Frame f = drawn([=](int x, int y) {
      return x >= 70 || x < 70 - seen ? near : y >= 60 ? middle : far;
    });
    EXPECT_EQ(count_of(marks_of(f)) > 0, seen == 6);
  }
}

/// Returns how many pixels lie behind something on a strip.
std::size_t expect_same_in_bands(const Frame& f) {
  const Words mixed = reference::TwinBackend().mixed(f);
  Silhouettes all, bands;
  continue_silhouettes(f, mixed, all);
  EXPECT_GT(count_of(all.marks), 100u);
  for (int y = 0; y < f.height; y += 16) {
    const Rows rows{y, std::min(y + 16, f.height)};
    // Of rows that it does not look at nothing matters.
    const Rows seen = rows.with(silhouette_rows(), f.height);
    const auto coc_at = [&](int x, int row) {
      return row < seen.y || row >= seen.end ? (x * row) % 7 * 900 : f.coc_quanta[f.index(x, row)];
    };
    Frame band = drawn(coc_at, f.height);
    band.wanted = rows;
    continue_silhouettes(band, mixed, bands);
  }
  std::size_t in_strips = 0;
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    EXPECT_EQ(bands.marks[i], all.marks[i]) << i;
    EXPECT_EQ(bands.strips[i], all.strips[i]) << i;
    in_strips += all.strips[i] > 0 ? 1 : 0;
  }
  return in_strips;
}

TEST(Silhouettes, AreTheSameInBandsOfRows) {
  const Frame f = drawn([](int x, int y) {
    if (std::abs(x - 40 - y / 3) < 12 || std::abs(x - 120 + y / 2) < 9) return 4 * near;
    if (std::abs(2 * y - x - 20) < 4 || std::abs(3 * y + x - 210) < 7) return middle - 1000;
    return (x * x / 40 + y) % 50 < 25 ? middle : (x - y / 5) % 40 < 20 ? far : far + 1000;
  });
  EXPECT_GT(expect_same_in_bands(f), 100u);
}

/// As far as they go on, from as far as their direction is looked for.
TEST(Silhouettes, AreTheSameInBandsFarFromTheirEnds) {
  const auto slanted = [](int x, int y) {
    if (y >= 100 && y < 200) return 8 * near;
    const int along = x + y / 3 + (y > 88 && y < 212 ? 0 : y / 2);
    return along % 80 < 4 || (along % 80 > 40 && along % 80 < 70) ? middle : far;
  };
  EXPECT_GT(expect_same_in_bands(drawn(slanted, 300)), 500u);
}

TEST(Silhouettes, KeepMixedPixelsAndTinyFrames) {
  const Frame f = slope(0.25, 86);
  const Words mixed = reference::TwinBackend().mixed(f), marks = marks_of(f);
  for (std::size_t i = 0; i < f.pixels(); ++i) EXPECT_EQ(marks[i] & DEFRAY_MIXED, mixed[i]);
  const Frame one{1, 1, std::vector<std::int32_t>{near}};
  EXPECT_EQ(marks_of(one)[0], 0u);
}

}  // namespace
}  // namespace defray::test::silhouettes_test
