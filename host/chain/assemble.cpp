#include "chain/assemble.h"

#include <algorithm>
#include <limits>

namespace defray {
namespace {

/// Coverage of a whole pixel; beyond the frame it was not seen.
std::uint32_t flags(const ExtendedFrame& e, std::size_t i) {
  return e.is_in_margin(i) ? DEFRAY_WHOLE | DEFRAY_SYNTHESISED : DEFRAY_WHOLE;
}

/// 1/depth becomes depth.
void invert(Plane& inverse) {
  for (float& i : inverse) {
    i = i < 0 ? no_fragment() : i == 0 ? std::numeric_limits<float>::infinity() : 1.0f / i;
  }
}

/// Two layers' planes row by row; they themselves are freed.
template <typename T>
std::vector<T> interleaved(std::vector<T>& front, std::vector<T>& behind, int width) {
  std::vector<T> rows(front.size() + behind.size());
  for (std::size_t at = 0; at < front.size(); at += size(width)) {
    std::copy_n(&front[at], width, &rows[2 * at]);
    std::copy_n(&behind[at], width, &rows[2 * at + size(width)]);
  }
  front = {};
  behind = {};
  return rows;
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

void count(const ExtendedFrame& e, const Surfaces& s, DefocusReport& report) {
  for (std::size_t i = 0; i < s.front.inverse.size(); ++i) {
    if (e.is_in_margin(i)) continue;
    report.split += !(s.front.inverse[i] < 0) && s.front.coverage[i] < DEFRAY_WHOLE;
    report.behind += !(s.behind.inverse[i] < 0) && s.behind.coverage[i] >= DEFRAY_SYNTHESISED;
  }
}

}  // namespace

Fragments whole_pixels(ExtendedFrame& e) {
  Fragments f{e.width,
              e.height,
              1,
              std::move(e.coc_quanta),
              std::move(e.inverse),
              {},
              std::move(e.channels),
              std::move(e.data)};
  invert(f.depth);
  for (std::size_t i = 0; i < f.depth.size(); ++i) f.coverage.push_back(flags(e, i));
  return f;
}

Fragments assemble(ExtendedFrame& e, Surfaces s, DefocusReport& report) {
  count(e, s, report);
  Fragments f{e.width, e.height, 2, {}, {}, {}, {}, {}};
  std::vector<std::uint32_t> data[2];
  int layer = 0;
  for (Surface* const from : {&s.front, &s.behind}) {
    for (std::size_t i = 0; i < e.data.size(); ++i) {
      data[layer].push_back(data_of(e, *from, layer, i));
    }
    for (std::size_t i = 0; i < from->coverage.size(); ++i) {
      const bool is_there = !(from->inverse[i] < 0);
      from->coverage[i] = is_there ? from->coverage[i] | (flags(e, i) & DEFRAY_SYNTHESISED) : 0;
    }
    invert(from->inverse);
    ++layer;
  }
  e.coc_quanta = {};
  e.inverse = {};
  e.channels = {};
  e.data = {};
  f.data_of = interleaved(data[0], data[1], e.width);
  f.coc_quanta = interleaved(s.front.coc_quanta, s.behind.coc_quanta, e.width);
  f.depth = interleaved(s.front.inverse, s.behind.inverse, e.width);
  f.coverage = interleaved(s.front.coverage, s.behind.coverage, e.width);
  for (std::size_t c = 0; c < s.front.channels.size(); ++c) {
    f.channels.push_back(interleaved(s.front.channels[c], s.behind.channels[c], e.width));
  }
  return f;
}

}  // namespace defray
