#include "assemble.h"

#include <algorithm>
#include <limits>

namespace defray {
namespace {

std::size_t size(int value) { return static_cast<std::size_t>(value); }

/// Coverage of a whole pixel; beyond the frame it was not seen.
std::uint32_t flags(const ExtendedFrame& e, std::size_t i) {
  return e.is_in_margin(i) ? DEFRAY_WHOLE | DEFRAY_SYNTHESISED : DEFRAY_WHOLE;
}

Plane depth_of(const Plane& inverse) {
  Plane depth;
  depth.reserve(inverse.size());
  for (const float i : inverse) {
    depth.push_back(i < 0    ? no_fragment()
                    : i == 0 ? std::numeric_limits<float>::infinity()
                             : 1.0f / i);
  }
  return depth;
}

/// Whose data a fragment has. One on its pixel's own surface: the pixel's. One in front of it,
/// which `split` found beside the pixel: that of the nearest pixel on its surface. What was made
/// up: none.
std::uint32_t data_of(const ExtendedFrame& e, const Surface& from, int layer, std::size_t i) {
  const auto is_on = [&](std::size_t pixel) {
    return e.inverse[pixel] == from.inverse[i] && e.coc_quanta[pixel] == from.coc_quanta[i];
  };
  if (layer == 1 && from.coverage[i] >= DEFRAY_SYNTHESISED) return DEFRAY_EMPTY;
  if (is_on(i)) return e.data[i];
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
      data = e.data[pixel];
    }
  }
  return data;
}

}  // namespace

Fragments whole_pixels(const ExtendedFrame& e) {
  Fragments f{e.width, e.height, 1, e.coc_quanta, {}, {}, e.channels};
  f.depth = depth_of(e.inverse);
  f.data_of = e.data;
  for (std::size_t i = 0; i < f.depth.size(); ++i) f.coverage.push_back(flags(e, i));
  return f;
}

Fragments assemble(const ExtendedFrame& e, const Surfaces& s, DefocusReport& report) {
  Fragments f{e.width, e.height, 2, {}, {}, {}, {}};
  f.channels.resize(e.channels.size());
  const Plane depths[2] = {depth_of(s.front.inverse), depth_of(s.behind.inverse)};
  const Surface* const surfaces[2] = {&s.front, &s.behind};
  for (int y = 0; y < e.height; ++y) {
    for (int layer = 0; layer < 2; ++layer) {
      const Surface& from = *surfaces[layer];
      for (std::size_t i = size(y) * size(e.width); i < (size(y) + 1) * size(e.width); ++i) {
        const bool is_there = is_fragment(depths[layer][i]);
        f.coc_quanta.push_back(from.coc_quanta[i]);
        f.depth.push_back(depths[layer][i]);
        f.coverage.push_back(is_there ? from.coverage[i] | (flags(e, i) & DEFRAY_SYNTHESISED) : 0);
        for (std::size_t c = 0; c < f.channels.size(); ++c) {
          f.channels[c].push_back(from.channels[c][i]);
        }
        if (!e.data.empty()) f.data_of.push_back(data_of(e, from, layer, i));
        if (e.is_in_margin(i) || !is_there) continue;
        report.behind += layer == 1 && from.coverage[i] >= DEFRAY_SYNTHESISED;
        report.split += layer == 0 && from.coverage[i] < DEFRAY_WHOLE;
      }
    }
  }
  return f;
}

}  // namespace defray
