// Place does not matter: a picture moves, turns, and is cut in bands, with its scene.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "properties.h"
#include "rdb/rdb_plan.h"

namespace defray::test::property_place_test {
namespace {

/// Content with a margin of sharp background wider than its blur.
constexpr int margin = 2 * reach_px + 2;

/// A sharp background of one colour.
RandomFrame background(Size size) {
  const std::size_t area = static_cast<std::size_t>(size.width) * size.height;
  return {size, std::vector<std::int32_t>(area), Plane(area, 100.0f), {Plane(area, 0.375f)}};
}

void paste(RandomFrame& into, const RandomFrame& content, int x0, int y0) {
  for (int y = 0; y < content.size.height; ++y) {
    for (int x = 0; x < content.size.width; ++x) {
      const std::size_t to = into.at(x0 + x, y0 + y), from = content.at(x, y);
      into.coc[to] = content.coc[from];
      into.depth[to] = content.depth[from];
      into.channels[0][to] = content.channels[0][from];
    }
  }
}

// Bit for bit with every method: offsets and weights depend on nothing but distance, and row-major
// indices keep their order. Aware gathers look as far as their tile: those move by whole tiles.
RC_GTEST_PROP(PlaceProperty, AMovedSceneGivesAMovedPicture, ()) {
  const RandomFrame content = any_frame({*rc::gen::inRange(1, 11), *rc::gen::inRange(1, 9)});
  const MethodSettings settings = any_method();
  const bool by_tiles =
      settings.method == Method::gather && settings.gather.kind == GatherKind::aware;
  const int step = by_tiles ? DEFRAY_GATHER_TILE : 1;
  const int dx = step * *rc::gen::inRange(0, 17 / step + 1);
  const int dy = step * *rc::gen::inRange(0, 17 / step + 1);
  const Size size{content.size.width + 2 * margin + 17, content.size.height + 2 * margin + 17};
  RandomFrame still = background(size), moved = still;
  paste(still, content, margin, margin);
  paste(moved, content, margin + dx, margin + dy);
  const Plane expected = render(still, settings), result = render(moved, settings);
  RC_LOG() << name_of(settings) << " by " << dx << "," << dy << std::endl;
  for (int y = 0; y + dy < size.height; ++y) {
    for (int x = 0; x + dx < size.width; ++x) {
      RC_ASSERT(result[still.at(x + dx, y + dy)] == expected[still.at(x, y)]);
    }
  }
}

RandomFrame turned(const RandomFrame& frame) {
  RandomFrame turn = frame;
  std::reverse(turn.coc.begin(), turn.coc.end());
  std::reverse(turn.depth.begin(), turn.depth.end());
  std::reverse(turn.channels[0].begin(), turn.channels[0].end());
  return turn;
}

// Half a turn maps lens points and the gather's antipodal samples to themselves. They are summed in
// another order, so the bound is that of two pictures; literal reads at 1 - part where it read at
// part, rounded (u a side, differences <= 2: 4 u a pass), and aware's three sums of weights (near,
// its rest, base; n u each, differences <= 2) differ too: 6 n u a pass and picture. Frames of whole
// tiles, an odd count of cells (no ray ends between pixels), and no equal depths, of which the
// index decides.
RC_GTEST_PROP(PlaceProperty, ATurnedSceneGivesATurnedPicture, ()) {
  RandomFrame frame = any_frame({16 * *rc::gen::inRange(1, 3), 16 * *rc::gen::inRange(1, 3)});
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    frame.depth[i] = 1.0f + (i * 7919) % frame.depth.size();  // 7919 is odd: each depth once
  }
  const MethodSettings settings = any_method();
  Plane result = render(turned(frame), settings);
  std::reverse(result.begin(), result.end());
  const double weight = largest_weight(frame, settings);
  const double of_order = settings.gather.passes * (4 + 12 * settings.gather.samples) * 0x1p-24;
  const double bound =
      (2 * rounding_of(settings, weight) + (settings.method == Method::gather ? of_order : 0)) *
      largest(frame.channels[0]);
  const double apart = difference(render(frame, settings), result);
  RC_LOG() << name_of(settings) << ": " << apart << " apart, allowed " << bound << std::endl;
  RC_ASSERT(apart <= bound);
}

// From one row of one cell (rdb) or one row with everything in its reach (linear, gather) on.
RC_GTEST_PROP(PlaceProperty, BandsDoNotShow, ()) {
  const RandomFrame frame = any_frame();
  MethodSettings settings = any_method();
  settings.rdb.jitter = *rc::gen::arbitrary<bool>();
  const std::uint64_t whole = bits(render(frame, settings));
  const auto width = static_cast<std::size_t>(frame.size.width);
  const std::size_t rdb = width * rdb_bytes_a_pixel(1) * *rc::gen::inRange<std::size_t>(1, 40);
  const std::size_t out_row = 16 * (width + DEFRAY_RUN - 1);
  const std::size_t in_row = 20 * (width + DEFRAY_RUN - 1 + 2 * reach_px);
  const std::size_t linear =
      2 * reach_px * in_row + (in_row + out_row) * *rc::gen::inRange<std::size_t>(1, 30);
  const std::size_t gather =  // 2 rows for what lies between pixels, and for rounding
      width * (2 * (reach_px + 2) * 20 + 36 * *rc::gen::inRange<std::size_t>(1, 30));
  RC_LOG() << name_of(settings) << std::endl;
  const InBands in_bands(session(), settings.method == Method::rdb      ? rdb
                                    : settings.method == Method::linear ? linear
                                                                        : gather);
  RC_ASSERT(bits(render(frame, settings)) == whole);
}

}  // namespace
}  // namespace defray::test::property_place_test
