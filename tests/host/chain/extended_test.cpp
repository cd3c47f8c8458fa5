// Frames extended by a border: as far as discs of the edge reach, each pixel the edge's nearest.
#include <algorithm>
#include <cmath>

#include "extended_frame.h"
#include "support.h"

namespace defray::test::extended_test {
namespace {

constexpr int width = 23, height = 14;

Frame frame_with(int x, int y, std::int32_t quanta) {
  const Size size{width, height};
  std::vector<std::int32_t> coc(static_cast<std::size_t>(width * height));
  coc[static_cast<std::size_t>(y * width + x)] = quanta;
  Plane depth = random_depth(size, 1);
  depth[5] = HUGE_VALF;
  Frame f{width, height, coc, depth, {random_plane(size, 2), random_plane(size, 3)}};
  f.has_alpha = true;
  f.origin_x = 7;
  f.origin_y = -4;
  f.display_width = 100;
  f.display_height = 50;
  return f;
}

int border_of(const Frame& f, ChainReport& report) {
  report = {};
  const Frame e = extended(f, Border::clamp, false, report);
  EXPECT_EQ(e.margin, report.border_px);
  EXPECT_EQ(e.width, f.width + 2 * e.margin);
  return e.margin;
}

TEST(Extended, ReachesAsFarAsTheDiscsOfTheFramesEdges) {
  ChainReport report;
  for (const std::int32_t quanta : {3 * 256, -3 * 256, 3 * 256 + 255}) {
    for (const auto& [x, y] : {std::pair{0, 5},
                               {width - 1, 5},
                               {9, 0},
                               {9, height - 1},
                               {0, 0},
                               {width - 1, height - 1}}) {
      EXPECT_EQ(border_of(frame_with(x, y, quanta), report), 4) << x << " " << y;
    }
    for (const auto& [x, y] : {std::pair{1, 5}, {width - 2, 5}, {9, 1}, {9, height - 2}}) {
      EXPECT_EQ(border_of(frame_with(x, y, quanta), report), 0) << x << " " << y;
    }
  }
  EXPECT_EQ(border_of(frame_with(0, 0, 1), report), 1);
  // Of so small a frame no more than 16 px.
  for (const auto& [px, border, is_cut] :
       {std::tuple{15, 16, false}, {16, 16, true}, {40, 16, true}}) {
    EXPECT_EQ(border_of(frame_with(0, 3, px * 256), report), border);
    EXPECT_EQ(report.border_is_cut, is_cut) << px;
  }
}

TEST(Extended, RepeatsTheNearestPixel) {
  const Frame f = frame_with(width - 1, 3, 5 * 256);
  for (const Border border : {Border::clamp, Border::black, Border::renormalise}) {
    ChainReport report;
    const Frame e = extended(f, border, true, report);
    const int m = border == Border::renormalise ? 0 : 6;
    ASSERT_EQ(e.margin, m);
    ASSERT_EQ(e.height, height + 2 * m);
    EXPECT_EQ(e.origin_x, 7 - m);
    EXPECT_EQ(e.origin_y, -4 - m);
    EXPECT_EQ(e.display_width, 100);
    EXPECT_TRUE(e.has_alpha);
    for (int y = 0; y < e.height; ++y) {
      for (int x = 0; x < e.width; ++x) {
        const std::size_t at = e.index(x, y);
        const int from_x = std::clamp(x - m, 0, width - 1),
                  from_y = std::clamp(y - m, 0, height - 1);
        const std::size_t from = f.index(from_x, from_y);
        const bool is_beyond = from_x != x - m || from_y != y - m;
        EXPECT_EQ(e.coc_quanta[at], f.coc_quanta[from]);
        EXPECT_EQ(e.inverse[at], std::isinf(f.depth[from]) ? 0 : 1 / f.depth[from]);
        EXPECT_EQ(e.data_of[at], from);
        for (std::size_t c = 0; c < 2; ++c) {
          EXPECT_EQ(e.channels[c][at],
                    border == Border::black && is_beyond ? 0 : f.channels[c][from]);
        }
      }
    }
  }
  ChainReport report;
  EXPECT_TRUE(extended(f, Border::clamp, false, report).data_of.empty());
}

}  // namespace
}  // namespace defray::test::extended_test
