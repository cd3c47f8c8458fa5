#include "chain/layers.h"

#include <algorithm>
#include <limits>

#include "kernels/params.h"

namespace defray {
namespace {

/// Whose data a surface has. One on its pixel's own surface: the pixel's. One in front of it,
/// which `split` found beside the pixel: that of the nearest pixel on its surface. What was made
/// up: none.
std::uint32_t data_of(const Frame& e, const Frame& from, int layer, std::size_t i) {
  const auto is_on = [&](std::size_t pixel) {
    return e.inverse[pixel] == from.inverse[i] && e.coc_quanta[pixel] == from.coc_quanta[i];
  };
  if (layer == 1 && from.coverage[i] >= DEFRAY_SYNTHESISED) return DEFRAY_EMPTY;
  if (is_on(i)) return e.data_of[i];
  const int x = static_cast<int>(i % size(e.width)), y = static_cast<int>(i / size(e.width));
  constexpr int reach = 3;  // as far as `split` looks
  int least = 2 * reach * reach + 1;
  std::uint32_t data = DEFRAY_EMPTY;
  for (int j = std::max(0, y - reach); j <= std::min(e.height - 1, y + reach); ++j) {
    for (int k = std::max(0, x - reach); k <= std::min(e.width - 1, x + reach); ++k) {
      const std::size_t pixel = size(j) * size(e.width) + size(k);
      const int distance = (j - y) * (j - y) + (k - x) * (k - x);
      if (distance >= least || !is_on(pixel)) continue;
      least = distance;
      data = e.data_of[pixel];
    }
  }
  return data;
}

void count(const Surfaces& s, ChainReport& report) {
  const auto front = s.front.inverse.host(), behind = s.behind.inverse.host();
  const auto front_coverage = s.front.coverage.host(), behind_coverage = s.behind.coverage.host();
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (s.front.is_in_margin(i)) continue;
    report.split += !(front[i] < 0) && front_coverage[i] < DEFRAY_WHOLE;
    report.behind += !(behind[i] < 0) && behind_coverage[i] >= DEFRAY_SYNTHESISED;
  }
}

}  // namespace

Frame whole_pixels(Frame f) {
  f.depth = std::move(f.inverse);
  f.inverse = {};
  for (float& z : f.depth.edit()) {
    z = z < 0 ? no_fragment() : z == 0 ? std::numeric_limits<float>::infinity() : 1.0f / z;
  }
  std::vector<std::uint32_t> coverage(f.pixels(), DEFRAY_WHOLE);
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    if (f.is_in_margin(i)) coverage[i] |= DEFRAY_SYNTHESISED;
  }
  f.coverage = std::move(coverage);
  return f;
}

Frame two_layers(Backend& backend, const Frame& frame, const Surfaces& s, ChainReport& report) {
  count(s, report);
  Frame f = backend.assemble(s);
  if (frame.data_of.empty()) return f;
  std::vector<std::uint32_t> data(f.surfaces());
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    const std::size_t front = f.front_of(i);
    data[front] = data_of(frame, s.front, 0, i);
    data[front + size(f.width)] = data_of(frame, s.behind, 1, i);
  }
  f.data_of = std::move(data);
  return f;
}

}  // namespace defray
