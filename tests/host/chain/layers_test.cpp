// Layers of a frame: whose data a surface has, what the report counts, what was made up.
#include "chain/steps/layers.h"

#include <cmath>
#include <limits>
#include <set>

#include "base/random.h"
#include "support.h"

namespace defray::test::layers_test {
namespace {

/// A frame of a few surfaces, and its layers as `split` may leave them.
struct LayerScene {
  static constexpr int width = 23, height = 17, margin = 2;
  Frame frame;
  Frame layers;
  Frame front, behind;  ///< Each layer by itself, with 1/depth.

  explicit LayerScene(std::uint32_t seed) {
    Plane inverse, front, behind;
    std::vector<std::int32_t> coc, front_coc, behind_coc;
    std::vector<std::uint32_t> data, front_coverage, behind_coverage;
    for (int i = 0; i < width * height; ++i) {
      Random random(i % width, i / width, seed);
      const auto surface = [&] { return static_cast<int>(25 * random.next()); };
      const int own = surface(), in_front = random.next() < 0.5 ? own : surface();
      inverse.push_back(0.1f * static_cast<float>(own));
      coc.push_back(100 * (own % 4));
      data.push_back(1000u + static_cast<std::uint32_t>(i));
      front.push_back(0.1f * static_cast<float>(in_front));
      front_coc.push_back(100 * (in_front % 4));
      front_coverage.push_back(random.next() < 0.5 ? DEFRAY_WHOLE : 1000);
      const int back = surface();
      const double kind = random.next();
      behind.push_back(kind < 0.3 ? -1 : 0.1f * static_cast<float>(back));
      behind_coc.push_back(100 * (back % 4));
      behind_coverage.push_back(DEFRAY_WHOLE | (kind < 0.7 ? DEFRAY_SYNTHESISED : 0));
    }
    frame.width = width;
    frame.height = height;
    frame.margin = margin;
    this->front = this->behind = frame.without_planes();
    frame.inverse = inverse;
    frame.coc_quanta = coc;
    frame.data_of = data;
    set(this->front, front, front_coc, front_coverage);
    set(this->behind, behind, behind_coc, behind_coverage);
    assemble();
  }
  /// As `split` writes them.
  void assemble() {
    std::vector<std::int32_t> coc;
    std::vector<std::uint32_t> coverage;
    Plane depth;
    for (int y = 0; y < height; ++y) {
      for (const Frame* layer : {&front, &behind}) {
        for (int x = 0; x < width; ++x) {
          const std::size_t i = frame.index(x, y);
          const float inverse = layer->inverse[i];
          coc.push_back(layer->coc_quanta[i]);
          depth.push_back(inverse < 0    ? no_fragment()
                          : inverse == 0 ? std::numeric_limits<float>::infinity()
                                         : 1 / inverse);
          const std::uint32_t seen = frame.is_in_margin(i) ? DEFRAY_SYNTHESISED : 0;
          coverage.push_back(inverse < 0 ? 0 : layer->coverage[i] | seen);
        }
      }
    }
    layers = frame.without_planes();
    layers.layers = 2;
    layers.coc_quanta = coc;
    layers.depth = depth;
    layers.coverage = coverage;
  }
  static void set(Frame& f, Plane inverse, std::vector<std::int32_t> coc,
                  std::vector<std::uint32_t> coverage) {
    f.inverse = std::move(inverse);
    f.coc_quanta = std::move(coc);
    f.coverage = std::move(coverage);
  }

  /// Its own pixel's, or that of the nearest pixel on this surface up to 3 px away.
  std::uint32_t expected_data(const Frame& layer, std::size_t i) const {
    std::set<std::pair<int, std::size_t>> on_surface;
    for (std::size_t k = 0; k < frame.pixels(); ++k) {
      const int dx = static_cast<int>(k % width) - static_cast<int>(i % width);
      const int dy = static_cast<int>(k / width) - static_cast<int>(i / width);
      const bool is_on =
          frame.inverse[k] == layer.inverse[i] && frame.coc_quanta[k] == layer.coc_quanta[i];
      if (is_on && std::max(std::abs(dx), std::abs(dy)) <= 3) {
        on_surface.insert({dx * dx + dy * dy, k});
      }
    }
    return on_surface.empty() ? DEFRAY_EMPTY : frame.data_of[on_surface.begin()->second];
  }
};

TEST(Layers, DataAreThoseOfTheNearestPixelOnTheSurface) {
  int from_beside = 0, from_nowhere = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    LayerScene s(seed);
    ChainReport report;
    Frame& two = s.layers;
    describe_layers(s.frame, two, report);
    for (std::size_t i = 0; i < s.frame.pixels(); ++i) {
      const int x = static_cast<int>(i) % LayerScene::width,
                y = static_cast<int>(i) / LayerScene::width;
      const std::uint32_t front = s.expected_data(s.front, i);
      EXPECT_EQ(two.data_of[two.index(x, y, 0)], front);
      from_beside += front != s.frame.data_of[i];
      const bool is_made_up = s.behind.coverage[i] >= DEFRAY_SYNTHESISED || s.frame.is_in_margin(i);
      const std::uint32_t behind = is_made_up ? DEFRAY_EMPTY : s.expected_data(s.behind, i);
      EXPECT_EQ(two.data_of[two.index(x, y, 1)], behind);
      from_nowhere += !is_made_up && behind == DEFRAY_EMPTY;
    }
  }
  EXPECT_GT(from_beside, 100);
  EXPECT_GT(from_nowhere, 10);
}

TEST(Layers, TheReportCountsThePicturesPixelsAlone) {
  LayerScene s(9);
  ChainReport report;
  describe_layers(s.frame, s.layers, report);
  std::size_t split = 0, behind = 0;
  for (int y = LayerScene::margin; y < LayerScene::height - LayerScene::margin; ++y) {
    for (int x = LayerScene::margin; x < LayerScene::width - LayerScene::margin; ++x) {
      const std::size_t i = s.frame.index(x, y);
      split += s.front.coverage[i] == 1000;
      behind +=
          s.behind.inverse[i] >= 0 && s.behind.coverage[i] == (DEFRAY_WHOLE | DEFRAY_SYNTHESISED);
    }
  }
  EXPECT_EQ(report.split, split);
  EXPECT_EQ(report.behind, behind);
  // No share where nothing is.
  LayerScene none(9);
  none.front.inverse = Plane(none.frame.pixels(), -1);
  none.assemble();
  ChainReport empty;
  describe_layers(none.frame, none.layers, empty);
  EXPECT_EQ(empty.split, 0u);
}

TEST(Layers, OfWholePixelsThoseInTheMarginAreMadeUp) {
  LayerScene s(2);
  Plane inverse(s.frame.pixels(), 0.25f);
  inverse[30] = 0;
  inverse[31] = -1;
  s.frame.inverse = inverse;
  Frame f = s.frame;
  make_whole(f);
  EXPECT_EQ(f.depth[29], 4);
  EXPECT_TRUE(std::isinf(f.depth[30]) && f.depth[30] > 0);
  EXPECT_FALSE(is_fragment(f.depth[31]));
  for (std::size_t i = 0; i < f.pixels(); ++i) {
    EXPECT_EQ(f.coverage[i], DEFRAY_WHOLE | (f.is_in_margin(i) ? DEFRAY_SYNTHESISED : 0)) << i;
  }
}

}  // namespace
}  // namespace defray::test::layers_test
