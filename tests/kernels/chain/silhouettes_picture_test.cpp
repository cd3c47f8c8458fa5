// What passes behind a blurred post, through the whole chain: a wire, and the edge of a table.
#include <gtest/gtest.h>

#include <functional>

#include "chain/chain.h"
#include "support.h"

namespace defray::test::silhouettes_picture_test {
namespace {

constexpr int width = 140, height = 100, post_from = 60, post_to = 80;
constexpr float wall = 0.9f, thing = 0.05f, post = 0.4f;
constexpr int columns[] = {post_from, post_from + 3, post_from + 6, post_to - 4, post_to - 1};

/// A thing in focus before a wall; the post in front of both is blurred by a disc of 20 pixels.
Frame picture(const std::function<bool(int x, int y)>& is_thing) {
  std::vector<std::int32_t> coc;
  Plane depth, colour;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_post = x >= post_from && x < post_to, is_there = is_thing(x, y);
      coc.push_back(is_post ? -10 * 256 : is_there ? 0 : 3 * 256);
      depth.push_back(is_post ? 1.0f : is_there ? 3.0f : 6.0f);
      colour.push_back(is_post ? post : is_there ? thing : wall);
    }
  }
  return {width, height, coc, depth, {colour}};
}

/// The colours behind the post, as far as they show, of all rows of a column.
std::vector<float> behind_post(const MethodResult& result, int column) {
  const auto at = [&](int y) { return result.colour[0][size(y * width + column)]; };
  const float shows = (at(10) - post) / (wall - post);  // the wall is there
  EXPECT_GT(shows, 0.05) << column;
  EXPECT_LT(shows, 0.55) << column;
  std::vector<float> colours;
  for (int y = 0; y < height; ++y) colours.push_back(post + (at(y) - post) / shows);
  return colours;
}

/// Colours of what lies at least `edge_px` from its edge.
void expect_straight(const std::function<bool(int x, int y)>& is_thing, int edge_px, float within) {
  for (const Hidden hidden : {Hidden::fill, Hidden::patterns}) {
    ChainSettings settings;
    settings.hidden = hidden;
    const MethodResult result = run_chain(picture(is_thing), settings, device(), false, {});
    for (const int x : columns) {
      const std::vector<float> colours = behind_post(result, x);
      for (int y = 5; y < height - 5; ++y) {
        const bool is_in = is_thing(x, y - edge_px) && is_thing(x, y + edge_px);
        // Beside its edge the wall is blurred.
        const bool is_out = !is_thing(x, y - 5) && !is_thing(x, y) && !is_thing(x, y + 5);
        const float is = colours[size(y)];
        if (is_in) EXPECT_NEAR(is, thing, within) << x << " " << y;
        if (is_out) EXPECT_NEAR(is, wall, within) << x << " " << y;
      }
    }
  }
}

TEST(SilhouettesPicture, AWireIsSeenThroughTheEdgesOfAPost) {
  expect_straight([](int, int y) { return y >= 47 && y < 53; }, 2, 0.3f);
}

TEST(SilhouettesPicture, ATableGoesOnBehindAPost) {
  // Where it comes out its edge is feathered.
  expect_straight([](int x, int y) { return y > 40 + 1.0 * (x - 70); }, 3, 0.3f);
}

}  // namespace
}  // namespace defray::test::silhouettes_picture_test
