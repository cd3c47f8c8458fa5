// Cat's eyes point at the middle of the display window, whatever its shape and wherever the data
// window lies in it.
#include <cmath>

#include "chain/chain.h"
#include "lens/cats_eye.h"
#include "lens/lens_grid.h"
#include "methods/method.h"
#include "rdb/rdb.h"
#include "support.h"

namespace defray::test::rim_test {
namespace {

TEST(Rim, IsOffTowardsTheMiddleByTheStrengthAtTheCorners) {
  constexpr double radius = 65536;
  for (const auto& [width, height] : {std::pair{400, 100}, {30, 200}, {64, 64}}) {
    const RimCentre corner = rim_centre(0.5, width, 0, width, height);
    EXPECT_NEAR(std::hypot(corner[0], corner[1]) / radius, 0.5, 1e-4);
    EXPECT_NEAR(std::atan2(-corner[1], -corner[0]), std::atan2(-height, width), 1e-4);
    const RimCentre middle = rim_centre(0.5, width / 2.0, height / 2.0, width, height);
    EXPECT_EQ(middle[0], 0);
    EXPECT_EQ(middle[1], 0);
    const RimCentre right = rim_centre(1, width, height / 2.0, width, height);
    EXPECT_NEAR(right[0] / radius, -width / std::hypot(width, height), 1e-4);
    EXPECT_EQ(right[1], 0);
  }
}

/// A lamp's disc, its middle relative to the lamp.
std::pair<double, double> shift_of(int width, int height, int lamp_x, int lamp_y, int origin_x,
                                   int origin_y, int display_width, int display_height) {
  Plane colour(static_cast<std::size_t>(width * height));
  colour[static_cast<std::size_t>(lamp_y * width + lamp_x)] = 5000;
  Frame frame{width,
              height,
              std::vector<std::int32_t>(colour.size(), 8 * 256),
              Plane(colour.size(), 4),
              {colour}};
  frame.display_width = display_width;
  frame.display_height = display_height;
  frame.origin_x = origin_x;
  frame.origin_y = origin_y;
  MethodSettings settings;
  settings.chain = ChainSettings{};
  settings.chain->aperture.cats_eye = 0.8;
  const Planes out = apply_method(frame, settings, device()).colour;
  double light = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    light += out[0][i];
    x += out[0][i] * (static_cast<int>(i) % width - lamp_x);
    y += out[0][i] * (static_cast<int>(i) / width - lamp_y);
  }
  return {x / light, y / light};
}

TEST(Rim, LampsLoseTheirOuterSide) {
  // A wide frame: the lamp is as far to the right of its middle as below, but for the eye.
  const auto [x, y] = shift_of(120, 60, 90, 45, 0, 0, 0, 0);
  EXPECT_LT(x, -0.3);
  EXPECT_NEAR(y / x, 15.0 / 30, 0.1);
  // The same as a part of a larger picture: elsewhere is the middle.
  const auto [part_x, part_y] = shift_of(60, 60, 30, 30, 0, 70, 60, 200);
  EXPECT_NEAR(part_x, 0, 0.05);
  EXPECT_NEAR(part_y, 0, 0.05);
  const auto [low_x, low_y] = shift_of(60, 60, 30, 30, 0, 140, 60, 200);
  EXPECT_NEAR(low_x, 0, 0.05);
  EXPECT_LT(low_y, -0.3);
}

TEST(Rim, ItsEdgeItselfIsOpen) {
  Frame frame{3, 1, std::vector<std::int32_t>(3), Plane(3, 4), {Plane(3, 1)}};
  RayPlan plan;
  plan.lens = make_lens_grid(1, false);  // its middle alone
  plan.rim_x = {65535, 65536, 65537};
  plan.rim_y = {0};
  for (const RaysBy by : {RaysBy::gather, RaysBy::scatter}) {
    plan.by = by;
    EXPECT_EQ(device().rays(frame, plan).seen, (std::vector<std::uint32_t>{1, 1, 0}));
  }
  EXPECT_EQ(twins().rays(frame, plan).seen, (std::vector<std::uint32_t>{1, 1, 0}));
}

/// Of an even wall the input determines all rays that pass the rim, however few, where they do not
/// come from beyond the frame.
TEST(Rim, ClosedCellsDoNotCountAsUnseen) {
  constexpr int width = 70, height = 50, reach = 5;
  const std::size_t count = width * height;
  Frame frame{width,
              height,
              std::vector<std::int32_t>(count, 3 * 256),
              Plane(count, 4),
              {random_plane({width, height}, 3)}};
  ChainSettings settings;
  settings.aperture.cats_eye = 1;
  const auto confidence = run_chain(frame, settings, device()).confidence;
  for (std::size_t i = 0; i < count; ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const bool is_inside =
        std::min(std::min(x, width - 1 - x), std::min(y, height - 1 - y)) >= reach;
    if (is_inside) {
      EXPECT_EQ(confidence[i], 1.0f) << x << " " << y;
    }
  }
  EXPECT_LT(confidence[count / 2 / width * width], 1.0f);  // the left edge
}

}  // namespace
}  // namespace defray::test::rim_test
