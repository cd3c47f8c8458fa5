// Kernel soften; and all stages on odd frames. That kernels equal their twins in frames of all
// kinds: 'defray validate'.
#include <algorithm>
#include <cmath>
#include <limits>

#include "faults/fault.h"
#include "lens/lens_grid.h"
#include "numbers.h"
#include "reference/twin_backend.h"
#include "stages_support.h"

namespace defray::test::soften_test {
namespace {

Frame flat_fragments(int width, int height, int layers, double radius_px) {
  Frame f;
  f.width = width;
  f.height = height;
  f.layers = layers;
  f.coc_quanta = Quanta(f.surfaces(), static_cast<std::int32_t>(256 * radius_px));
  f.depth = Values<float>(f.surfaces(), 2);
  f.coverage = Words(f.surfaces(), DEFRAY_WHOLE);
  f.channels = Planes{Values<float>(f.surfaces())};
  return f;
}

TEST(Soften, OneColourStaysBitForBit) {
  for (const float colour :
       {0.1f, -0.0f, 1e-45f, std::numeric_limits<float>::max(), infinite, nan}) {
    Frame f = flat_fragments(23, 17, 2, 40);
    f.channels[0] = Values<float>(f.coc_quanta.size(), colour);
    expect_same_bits(device().soften(f, 16)[0], f.channels[0]);
  }
}

TEST(Soften, ACellBelowAPixelChangesNothing) {
  Frame f = flat_fragments(23, 17, 1, 0);
  f.channels[0] = random_plane({23, 17}, 4);
  // The diameter is as many pixels as a grid has cells a side.
  const auto sharp = static_cast<std::int32_t>(128 * cells_per_side(64));
  for (const std::int32_t quanta : {0, sharp, -sharp}) {
    f.coc_quanta = Quanta(f.surfaces(), quanta);
    expect_same_bits(device().soften(f, 64)[0], f.channels[0]);
  }
  f.coc_quanta = Quanta(f.surfaces(), 2 * sharp);
  EXPECT_NE(hash_of_planes(device().soften(f, 64)), hash_of_planes(f.channels));
}

TEST(Soften, ABrightPixelIsSpreadOverTheCellAndKeepsItsEnergy) {
  for (const double radius : {6.0, -10.0, 20.0, 80.0}) {
    Frame f = flat_fragments(101, 101, 1, radius);
    f.channels[0].edit()[f.index(50, 50, 0)] = 1000;
    const auto out = device().soften(f, 64)[0];
    const double cell = 2 * std::fabs(radius) / cells_per_side(64);
    double sum = 0;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        const float value = out[f.index(x, y, 0)];
        sum += value;
        EXPECT_GE(value, -1e-4f);
        const int away = std::max(std::abs(x - 50), std::abs(y - 50));
        if (away >= cell / 2 + 0.5) {
          EXPECT_EQ(value, 0.0f) << x << " " << y;
        }
      }
    }
    EXPECT_NEAR(sum, 1000, 1000 * 1e-5) << radius;
    EXPECT_LT(out[f.index(50, 50, 0)], 1000 / std::min(cell * cell, 49.0) * 1.7) << radius;
  }
}

/// The definition once more: pixels are squares, a cell is a square of 2 r / n, their overlap
/// counts.
TEST(Soften, IsTheMeanOverTheCellsSquare) {
  constexpr int side = 41, middle = side / 2, lens_points = 100;
  for (const double radius : {7.0, 12.3, 20.0, 33.7}) {
    Frame f = flat_fragments(side, side, 1, radius);
    const Plane colour = random_plane({side, side}, 5);
    f.channels[0] = colour;
    const double cell = 2 * std::fabs(f.coc_quanta[0] / 256.0) / cells_per_side(lens_points);
    const auto overlap = [&](int d) {
      return std::fmax(0, std::fmin(d + 0.5, cell / 2) - std::fmax(d - 0.5, -cell / 2));
    };
    double sum = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        sum += overlap(x - middle) * overlap(y - middle) * colour[f.index(x, y, 0)];
      }
    }
    ASSERT_GT(cell, 1);
    const double mean = sum / (cell * cell), size_of = std::fabs(mean) + 1;
    EXPECT_NEAR(device().soften(f, lens_points)[0][f.index(middle, middle, 0)], mean,
                1e-4 * size_of)
        << radius;
  }
}

TEST(Soften, SurfacesDoNotMixNorDoLayersOrEmptyOnes) {
  Frame f = flat_fragments(40, 20, 2, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (x >= 20) f.coc_quanta.edit()[f.index(x, y, 0)] = 10 * 256;
      f.channels[0].edit()[f.index(x, y, 0)] = x >= 20 ? 1.0f : 0.25f;
      f.channels[0].edit()[f.index(x, y, 1)] = x % 5 == 0 ? 100.0f : 7.0f;
      if (x % 5 == 0) f.coverage.edit()[f.index(x, y, 1)] = DEFRAY_SYNTHESISED;  // covers nothing
    }
  }
  expect_same_bits(device().soften(f, 16)[0], f.channels[0]);
}

TEST(Soften, WithoutCoverageEveryFragmentIsWhole) {
  Frame f = flat_fragments(20, 20, 1, 20);
  f.channels[0] = random_plane({20, 20}, 3);
  const auto whole = device().soften(f, 16);
  f.coverage = {};
  EXPECT_EQ(hash_of_planes(device().soften(f, 16)), hash_of_planes(whole));
  EXPECT_EQ(hash_of_planes(twins().soften(f, 16)), hash_of_planes(whole));
}

TEST(Stages, SmallFramesHugeCocAndOddColoursEqualTheTwins) {
  for (const Size size : {Size{1, 1}, {1, 9}, {9, 1}, {2, 2}, {17, 33}}) {
    for (const double coc_px : {8.0, 4194304.0}) {
      Canvas f(size.width, size.height);
      for (std::size_t i = 0; i < f.count(); ++i) {
        f.coc[i] = static_cast<std::int32_t>(256 * coc_px * (i / 5 % 3 - 1.0));
        f.inverse[i] = i % 7 ? 0.1f * static_cast<float>(i % 7) : infinite;
        f.channels[0][i] = i % 11 == 0 ? nan : i % 5 == 0 ? infinite : 0.3f;
      }
      Frame deep = f.view();
      deep.depth = f.inverse;
      EXPECT_EQ(device().repair(deep), twins().repair(deep));
      const Words mixed = twins().mixed({f.width, f.height, f.coc});
      EXPECT_EQ(f.mixed(), mixed);
      const Frame behind = f.filled(), twin = twins().fill(f.view(), mixed, DEFRAY_FILL_DIRECTIONS);
      EXPECT_EQ(behind.coc_quanta, twin.coc_quanta);
      const auto [front, rest] = f.parted();
      const Parted by_twins(twins().split(f.view(), mixed, twin));
      EXPECT_EQ(front.coverage, by_twins.front.coverage);
      EXPECT_EQ(rest.coc_quanta, by_twins.behind.coc_quanta);
    }
  }
}

const FaultRows faults{
    {"soften", "radius for diameter", {"(2.0f / 256.0f) / p.cells", "(1.0f / 256.0f) / p.cells"}},
    {"soften",
     "near side forgotten",
     {"fabs(convert_float16(own_coc)) * (2.0f", "convert_float16(own_coc) * (2.0f"}},
    {"soften", "layers mixed up", {"* (int)p.layers + layer;", "* (int)p.layers;"}},
    {"soften", "row of a layer for a row of the frame", {"* (int)p.layers + layer;", "+ layer;"}},
    {"soften", "other surfaces too", {" & (apart <= s.alike)", ""}},
    {"soften", "a whole cell apart", {"s.alike = 128.0f", "s.alike = 256.0f"}},
    {"soften",
     "square's soft border",
     {"half_side + 0.5f - convert_float16", "half_side + 1.0f - convert_float16"}},
    {"soften", "coverage ignored", {"inside(s.half_side, dy) * share", "inside(s.half_side, dy)"}},
    {"soften", "coverage's flag taken for a share", {"from) & (int)~DEFRAY_SYNTHESISED", "from)"}},
    {"soften",
     "last column of the square",
     {"for (int i = -most; i <= most; ++i)", "for (int i = -most; i < most; ++i)"}},
    {"soften",
     "a tap beyond the frame counts",
     {"(x + dx < (int)p.width)", "(x + dx <= (int)p.width)"}},
    {"soften",
     "fragments of a run with other strides read beside each other",
     {"places.is_line = all_lanes(", "places.is_line = any_lane("}},
    {"soften",
     "wide squares without a stride",
     {"dx = s.stride * i, dy = s.stride * j", "dx = i, dy = j"}},
    {"soften", "-0 becomes +0", {"(difference == 0.0f) | ~isfinite", "~isfinite"}},
    {"soften",
     "Inf becomes NaN",
     {"(difference == 0.0f) | ~isfinite(own)", "(difference == 0.0f)"}},
    {"soften",
     "stale output: sharp fragments",
     {"  write_mean(out0", "  if (any_lane(s.is_active)) write_mean(out0"}},
};

}  // namespace
}  // namespace defray::test::soften_test
