// Thin surfaces that go on behind what hides them.
#include "chain/silhouettes/strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "chain/silhouettes/silhouettes.h"
#include "kernels/params.h"
#include "reference/twin_backend.h"

namespace defray::test::strips_test {
namespace {

constexpr std::int32_t near = -5120, middle = 0, far = 2048;  // quanta; 256 are a pixel
constexpr int width = 160, height = 120;

Frame drawn(const std::function<std::int32_t(int x, int y)>& coc_at) {
  std::vector<std::int32_t> coc;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) coc.push_back(coc_at(x, y));
  }
  return Frame{width, height, std::move(coc)};
}

Silhouettes of(const Frame& f) {
  Silhouettes all;
  continue_silhouettes(f, reference::TwinBackend().mixed(f), all);
  return all;
}

std::uint32_t at(const Words& words, int x, int y) { return words[size(y * width + x)]; }

std::size_t count(const Words& strips) {
  const auto lies = [](std::uint32_t from) { return from > 0; };
  return static_cast<std::size_t>(std::count_if(strips.begin(), strips.end(), lies));
}

/// A straight strip through (80, 60).
struct Strip {
  double wide, rise;

  /// From its middle, in pixels; positive: outside.
  double outside(int x, int y) const {
    const double below = y + 0.5 - 60 - rise * (x + 0.5 - 80);
    return std::abs(below) / std::sqrt(1 + rise * rise) - wide / 2;
  }
};

/// It lies in front of what is far; a near bar of columns hides it.
Frame behind_bar(Strip strip, int from = 70, int to = 86) {
  return drawn([=](int x, int y) {
    if (x >= from && x < to) return near;
    return strip.outside(x, y) < 0 ? middle : far;
  });
}

TEST(Strips, GoOnBehindABar) {
  for (const double rise : {0.0, 0.25, -0.5, 1.0, -2.0}) {
    for (const double wide : {1.5, 2.0, 3.0, 4.0, 5.0}) {
      const Strip strip{wide, rise};
      const Frame f = behind_bar(strip);
      const Words strips = of(f).strips;
      double area = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const std::uint32_t from = at(strips, x, y);
          const double outside = strip.outside(x, y);
          const bool is_hidden = x >= 70 && x < 86;
          area += is_hidden && outside < 0 ? 1 : 0;
          if (!is_hidden || outside > 1.6)
            EXPECT_EQ(from, 0u) << wide << " " << rise << " " << x << " " << y;
          if (is_hidden && outside < -0.9)
            EXPECT_GT(from, 0u) << wide << " " << rise << " " << x << " " << y;
          if (from > 0) EXPECT_EQ(f.coc_quanta[from - 1], middle);
        }
      }
      EXPECT_NEAR(static_cast<double>(count(strips)), area, 0.25 * area) << wide << " " << rise;
    }
  }
}

/// As silhouettes: (0 + 5120) / 256 + 2 px. All along what hides it where it comes out again.
TEST(Strips, GoOnAsFarAsTheLensLooks) {
  const Words strips = of(behind_bar({4, 0}, 70, width)).strips;
  EXPECT_GT(at(strips, 70 + 21, 60), 0u);
  EXPECT_EQ(at(strips, 70 + 23, 60), 0u);
  for (const int hidden : {60, 70}) {
    const Words joined = of(behind_bar({4, 0}, 70, 70 + hidden)).strips;
    EXPECT_EQ(at(joined, 70 + hidden / 2, 60) > 0, hidden == 60);
  }
}

/// A surface of seven pixels is wide. One whose sides are nearer is a slit.
TEST(Strips, AreThinAndInFront) {
  EXPECT_GT(count(of(behind_bar({6, 0})).strips), 60u);
  EXPECT_EQ(count(of(behind_bar({7.1, 0})).strips), 0u);
  const Frame slit = drawn([](int x, int y) {
    return x >= 70 && x < 86 ? near : y >= 58 && y < 62 ? far : middle;
  });
  EXPECT_EQ(count(of(slit).strips), 0u);
}

TEST(Strips, TheNearerCrossesTheFarther) {
  for (const std::int32_t level : {middle - 1000, middle + 1000}) {
    const Frame f = drawn([=](int x, int y) {
      if (x >= 70 && x < 90 && y >= 50 && y < 70) return 2 * near;
      if (y >= 58 && y < 62) return level;
      return x >= 78 && x < 82 ? middle : far;
    });
    const std::uint32_t from = at(of(f).strips, 80, 60);
    ASSERT_GT(from, 0u);
    EXPECT_EQ(f.coc_quanta[from - 1], std::min(level, middle));
  }
}

/// `fill` finds nothing on what is thin, whatever its direction.
TEST(Strips, AreMixedForFill) {
  for (const double rise : {0.0, 1.0, -1.0, 4.0}) {
    for (const double wide : {3.0, 5.5, 8.5}) {
      const Strip strip{wide, rise};
      const Frame f = behind_bar(strip, 0, 0);
      const Words marks = of(f).marks, mixed = reference::TwinBackend().mixed(f);
      for (int y = 20; y < height - 20; ++y) {
        for (int x = 20; x < width - 20; ++x) {
          if (mixed[size(y * width + x)]) continue;
          const bool is_thin = wide < thin_px && strip.outside(x, y) < 0;
          EXPECT_EQ(at(marks, x, y) & DEFRAY_MIXED, is_thin ? DEFRAY_MIXED : 0u) << wide << rise;
        }
      }
    }
  }
}

TEST(Strips, SlitsAreNotMixed) {
  const Frame f = drawn([](int, int y) { return y >= 58 && y < 63 ? far : middle; });
  const Words mixed = reference::TwinBackend().mixed(f), marks = of(f).marks;
  for (std::size_t i = 0; i < f.pixels(); ++i) EXPECT_EQ(marks[i], mixed[i]);
}

TEST(Strips, OfOtherRowsOrFramesAreNone) {
  const Frame f = behind_bar({4, 0}), none = behind_bar({4, 0}, 0, 0);
  Silhouettes all = of(f);
  ASSERT_GT(at(all.strips, 78, 60), 0u);
  continue_silhouettes(none, reference::TwinBackend().mixed(none), all);
  EXPECT_EQ(at(all.strips, 78, 60), 0u);
}

TEST(Strips, ArePaintedBehind) {
  Frame f = behind_bar({4, 0.25}), behind = f.without_planes();
  Plane inverse, colour;
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    inverse.push_back(static_cast<float>(i));
    colour.push_back(static_cast<float>(2 * i));
  }
  f.inverse = inverse;
  f.channels = {colour, inverse};
  behind.coc_quanta = std::vector<std::int32_t>(f.pixels(), far);
  behind.inverse = Plane(f.pixels(), -1);
  behind.channels = {Plane(f.pixels(), 7), Plane(f.pixels(), 8)};
  const Words strips = of(f).strips;
  f.wanted = Rows{32, 61};
  paint_strips(f, strips, behind);
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    const int y = static_cast<int>(i) / width;
    const bool is_painted = strips[i] > 0 && y >= 32 && y < 61;
    const auto from = static_cast<float>(strips[i]) - 1;
    EXPECT_EQ(behind.coc_quanta[i], is_painted ? middle : far);
    EXPECT_EQ(behind.inverse[i], is_painted ? from : -1);
    EXPECT_EQ(behind.channels[0][i], is_painted ? 2 * from : 7);
    EXPECT_EQ(behind.channels[1][i], is_painted ? from : 8);
  }
}

}  // namespace
}  // namespace defray::test::strips_test
