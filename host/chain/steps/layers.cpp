#include "chain/steps/layers.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/parallel.h"
#include "kernels/params.h"

namespace defray {
namespace {

float depth_of(float inverse) {
  return inverse < 0    ? no_fragment()
         : inverse == 0 ? std::numeric_limits<float>::infinity()
                        : 1.0f / inverse;
}

/// Whose data a surface of two layers has. One on its pixel's own surface: the pixel's. One in
/// front of it, which `split` found beside the pixel: that of the nearest pixel on its surface.
/// What was made up: none.
std::uint32_t data_of(const Frame& e, const Frame& two, int x, int y, int layer) {
  const std::size_t i = two.index(x, y, layer);
  const auto is_on = [&](std::size_t pixel) {
    return depth_of(e.inverse[pixel]) == two.depth[i] && e.coc_quanta[pixel] == two.coc_quanta[i];
  };
  if (layer == 1 && two.coverage[i] >= DEFRAY_SYNTHESISED) return DEFRAY_EMPTY;
  if (is_on(e.index(x, y))) return e.data_of[e.index(x, y)];
  constexpr int reach = DEFRAY_SPLIT_PX;
  int least = 2 * reach * reach + 1;
  std::uint32_t data = DEFRAY_EMPTY;
  for (int j = std::max(0, y - reach); j <= std::min(e.height - 1, y + reach); ++j) {
    for (int k = std::max(0, x - reach); k <= std::min(e.width - 1, x + reach); ++k) {
      const int distance = (j - y) * (j - y) + (k - x) * (k - x);
      if (distance >= least || !is_on(e.index(k, j))) continue;
      least = distance;
      data = e.data_of[e.index(k, j)];
    }
  }
  return data;
}

void count(const Frame& two, ChainReport& report) {
  const auto coverage = two.coverage.host();
  const Rows rows{std::max(two.wanted_rows().y, two.margin),
                  std::min(two.wanted_rows().end, two.height - two.margin)};
  std::atomic<std::size_t> split = 0, behind = 0;
  parallel_for(rows.count(), [&](int row) {
    std::size_t split_here = 0, behind_here = 0;
    for (int x = two.margin; x < two.width - two.margin; ++x) {
      const std::uint32_t front = coverage[two.index(x, rows.y + row, 0)];
      split_here += front > 0 && front < DEFRAY_WHOLE;
      behind_here += coverage[two.index(x, rows.y + row, 1)] >= DEFRAY_SYNTHESISED;
    }
    split += split_here;
    behind += behind_here;
  });
  report.split += split;
  report.behind += behind;
}

}  // namespace

void make_whole(Frame& f) {
  if (f.depth.empty()) f.depth = Values<float>::room(f.pixels());
  if (f.coverage.empty()) f.coverage = Words::room(f.pixels());
  const auto inverse = f.inverse.host();
  const auto depth = f.depth.edit();
  const auto coverage = f.coverage.edit();
  const Rows rows = f.wanted_rows();
  const std::size_t first = f.index(0, rows.y);
  parallel_for_each(f.index(0, rows.end) - first, [&](std::size_t k) {
    const std::size_t i = first + k;
    depth[i] = depth_of(inverse[i]);
    coverage[i] = DEFRAY_WHOLE | (f.is_in_margin(i) ? DEFRAY_SYNTHESISED : 0u);
  });
}

void describe_layers(const Frame& frame, Frame& layers, ChainReport& report) {
  count(layers, report);
  if (frame.data_of.empty()) return;
  if (layers.data_of.empty()) layers.data_of = Words::room(layers.surfaces());
  const auto data = layers.data_of.edit();
  const Rows rows = layers.wanted_rows();
  for (int y = rows.y; y < rows.end; ++y) {
    for (int layer = 0; layer < layers.layers; ++layer) {
      for (int x = 0; x < frame.width; ++x) {
        data[layers.index(x, y, layer)] = data_of(frame, layers, x, y, layer);
      }
    }
  }
}

}  // namespace defray
