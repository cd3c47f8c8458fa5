// Depth only orders: which surface is nearer, never by how much; among equals the smaller index.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "device/rdb_scatter.h"
#include "lens/lens_grid.h"
#include "properties.h"

namespace defray::test::property_depth_test {
namespace {

/// The source of every cell of every pixel, [cell][y][x]; all ones where no ray arrives.
std::vector<std::uint32_t> winners(const RandomFrame& frame, int cells_per_side) {
  const Frame all{frame.size.width, frame.size.height, frame.coc, frame.depth, frame.channels};
  const RayPlan plan = plan_rays({cells_per_side});
  RdbScatter run(session(), all, plan);
  RC_ASSERT(run.passes().size() == 1u);
  run.scatter(run.passes()[0]);
  std::vector<std::uint32_t> sources;
  for (const RdbWinner& winner : run.winners(run.passes()[0])) sources.push_back(winner.source);
  return sources;
}

std::vector<std::size_t> in_order(const RandomFrame& frame) {
  std::vector<std::size_t> order(frame.depth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return frame.depth[a] < frame.depth[b]; });
  return order;
}

/// A depth beyond z, by anything from one ulp to several times as far.
float beyond(float z, std::mt19937& random) {
  const float next = std::nextafter(z, std::numeric_limits<float>::infinity());
  return random() % 2 == 0 ? next : std::fmax(next, z * (1 + random() % 64 / 256.0f));
}

RC_GTEST_PROP(DepthProperty, OnlyTheOrderOfDepthsCounts, ()) {
  const RandomFrame frame = any_frame();
  const int cells = *rc::gen::inRange(1, 8);
  std::mt19937 random(*rc::gen::inRange<std::uint32_t>(0, 1u << 16));
  RandomFrame mapped = frame;
  float z = 1e-3f, last = 0;
  for (const std::size_t i : in_order(frame)) {
    if (frame.depth[i] != last) z = beyond(z, random);
    last = frame.depth[i];
    mapped.depth[i] = z;
  }
  RC_ASSERT(winners(frame, cells) == winners(mapped, cells));
}

RC_GTEST_PROP(DepthProperty, AmongEqualDepthsTheSmallerIndexIsNearer, ()) {
  const RandomFrame frame = any_frame();
  const int cells = *rc::gen::inRange(1, 8);
  RandomFrame untied = frame;
  float z = 1;
  for (const std::size_t i : in_order(frame)) {  // stable: equal depths by index
    untied.depth[i] = z;
    z = std::nextafter(z, 2.0f);
  }
  RC_ASSERT(winners(frame, cells) == winners(untied, cells));
}

/// Whether a ray of some cell ends exactly between two pixels, where [-1/2, 1/2) takes a side.
bool has_rays_on_borders(const RandomFrame& frame, const LensPoints& lens) {
  constexpr std::int64_t pixel = std::int64_t{1}
                                 << (DEFRAY_COC_FRACTION_BITS + DEFRAY_LENS_FRACTION_BITS);
  for (const std::int64_t r : frame.coc) {
    for (const auto& [u, v] : lens.points) {
      if (((r * u) & (pixel - 1)) == pixel / 2 || ((r * v) & (pixel - 1)) == pixel / 2) return true;
    }
  }
  return false;
}

/// No two depths are equal: among equals the mirror would choose another.
void untie(RandomFrame& frame, std::uint32_t seed) {
  std::vector<std::size_t> order(frame.depth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  for (std::size_t i = 0; i < order.size(); ++i) frame.depth[i] = 1.0f + order[i];
}

RandomFrame mirrored(const RandomFrame& frame) {
  RandomFrame mirror = frame;
  for (int y = 0; y < frame.size.height; ++y) {
    for (int x = 0; x < frame.size.width; ++x) {
      const std::size_t to = frame.at(frame.size.width - 1 - x, y), from = frame.at(x, y);
      mirror.coc[to] = frame.coc[from];
      mirror.depth[to] = frame.depth[from];
    }
  }
  return mirror;
}

/// The cell on the other side of the lens's vertical axis.
std::size_t mirrored_cell(const LensPoints& lens, std::size_t cell) {
  const auto [u, v] = lens.points[cell];
  const auto found =
      std::find(lens.points.begin(), lens.points.end(), std::array<std::int32_t, 2>{-u, v});
  RC_ASSERT(found != lens.points.end());
  return static_cast<std::size_t>(found - lens.points.begin());
}

// An odd count of cells: their coordinates have so few factors of two that no radius of these
// frames puts a ray on a border. That is checked, not assumed.
RC_GTEST_PROP(DepthProperty, AMirroredSceneThroughAMirroredLensIsMirrored, ()) {
  RandomFrame frame = any_frame();
  untie(frame, *rc::gen::inRange<std::uint32_t>(0, 1u << 16));
  const int side = *rc::gen::element(1, 3, 5, 7);
  const LensPoints lens = make_lens_grid(side, false);
  RC_ASSERT(!has_rays_on_borders(frame, lens));
  const auto plain = winners(frame, side), mirror = winners(mirrored(frame), side);
  const std::size_t area = frame.depth.size();
  for (std::size_t cell = 0; cell < lens.points.size(); ++cell) {
    const std::size_t other = mirrored_cell(lens, cell);
    for (int y = 0; y < frame.size.height; ++y) {
      for (int x = 0; x < frame.size.width; ++x) {
        const auto from = [&](std::uint32_t source) -> std::int64_t {
          if (source == DEFRAY_EMPTY) return -1;
          const int column = source % frame.size.width, row = source / frame.size.width;
          return static_cast<std::int64_t>(frame.at(frame.size.width - 1 - column, row));
        };
        const std::uint32_t source = plain[cell * area + frame.at(x, y)];
        const std::int64_t expected = source == DEFRAY_EMPTY ? -1 : std::int64_t{source};
        RC_ASSERT(from(mirror[other * area + frame.at(frame.size.width - 1 - x, y)]) == expected);
      }
    }
  }
}

}  // namespace
}  // namespace defray::test::property_depth_test
