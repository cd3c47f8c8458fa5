#include "chain/steps/border.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "base/parallel.h"
#include "lens/coc.h"
#include "rdb/rdb_plan.h"

namespace defray {
namespace {

int margin_of(const Frame& f, Border border, ChainReport& report) {
  if (border == Border::renormalise) return 0;
  std::int32_t largest = 0;
  const auto coc = f.coc_quanta.host();
  const auto look = [&](int x, int y) {
    largest = std::max(largest, std::abs(coc[f.index(x, y)]));
  };
  for (int x = 0; x < f.width; ++x) look(x, 0), look(x, f.height - 1);
  for (int y = 0; y < f.height; ++y) look(0, y), look(f.width - 1, y);
  const int wanted = largest == 0 ? 0 : rdb_reach(largest);
  const int most = std::max(16, std::min(f.width, f.height) / 2);
  report.border_px = std::min(wanted, most);
  report.border_is_cut = wanted > most;
  return report.border_px;
}

/// Rows of `to`, a plane of the extended frame, from the picture's: value(pixel of it).
template <typename T, typename Value>
void repeat_rows(const Frame& e, Values<T>& to, Rows rows, const Value& value) {
  if (to.empty()) to = Values<T>::room(e.pixels());
  const std::span<T> out = to.edit();
  parallel_for(rows.count(), [&](int row) {
    const int y = rows.y + row;
    T* const line = &out[e.index(0, y)];
    const std::size_t first = picture_pixel(e, 0, y), width = size(e.width - 2 * e.margin);
    std::fill_n(line, e.margin, value(first));
    for (std::size_t x = 0; x < width; ++x) line[size(e.margin) + x] = value(first + x);
    std::fill_n(line + size(e.margin) + width, e.margin, value(first + width - 1));
  });
}

/// A line of front fragments from the frame's edge inwards, and outwards at negative places.
struct Line {
  std::span<const std::int32_t> coc;
  std::size_t edge;
  std::ptrdiff_t inward;

  std::size_t at(int place) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(edge) + place * inward);
  }
  /// How many fragments from the edge on are of one surface, at most so many.
  int surface(int most) const {
    int count = 1;
    while (count < most &&
           std::abs(tame(coc[at(count)]) - tame(coc[at(count - 1)])) <= DEFRAY_JUMP_QUANTA)
      ++count;
    return count;
  }
};

void continue_line(const Line& line, int surface, int margin, std::span<float> plane) {
  const float edge = plane[line.at(0)];
  float sum = 0;  // of differences: one colour stays that colour
  for (int d = 0; d < margin; ++d) {
    if (d < surface) sum += plane[line.at(d)] - edge;
    const float colour = edge + sum / static_cast<float>(std::min(d + 1, surface));
    if (std::isfinite(colour)) plane[line.at(-1 - d)] = colour;
  }
}

void clear_margin(const Frame& e, Rows rows, std::span<float> plane) {
  for (std::size_t i = e.index(0, rows.y); i < e.index(0, rows.end); ++i) {
    if (e.is_in_margin(i)) plane[i] = 0;
  }
}

}  // namespace

void continue_colours(Frame& f) {
  const int m = f.margin;
  if (m == 0) return;
  std::vector<std::span<float>> channels;
  for (Values<float>& channel : f.channels) channels.push_back(channel.edit());
  const auto coc = f.coc_quanta.host();
  const auto go_on = [&](int x, int y, int step_x, int step_y, int length) {
    const auto inward = static_cast<std::ptrdiff_t>(step_y) * f.layers * f.width + step_x;
    const Line line{coc, f.index(x, y), inward};
    const int surface = line.surface(std::min(length, m));
    for (const std::span<float> plane : channels) continue_line(line, surface, m, plane);
  };
  const Rows wanted = f.wanted_rows();
  const int top = m, bottom = f.height - m;  // of the picture
  const int first = std::max(wanted.y, top), end = std::min(wanted.end, bottom);
  parallel_for(end - first, [&](int row) {
    go_on(m, first + row, 1, 0, f.width - 2 * m);
    go_on(f.width - m - 1, first + row, -1, 0, f.width - 2 * m);
  });
  parallel_for(f.width, [&](int x) {  // their margins, too
    if (wanted.y == 0) go_on(x, top, 0, 1, bottom - top);
    if (wanted.end == f.height) go_on(x, bottom - 1, 0, -1, bottom - top);
  });
}

int rows_to_continue(const Frame& f) { return std::min(2 * f.margin, f.height - f.margin); }

std::size_t picture_pixel(const Frame& e, int x, int y) {
  const int width = e.width - 2 * e.margin, height = e.height - 2 * e.margin;
  return size(std::clamp(y - e.margin, 0, height - 1)) * size(width) +
         size(std::clamp(x - e.margin, 0, width - 1));
}

float inverse_of(float depth) { return std::isinf(depth) ? 0.0f : 1.0f / depth; }

Frame with_margin(const Frame& f, Border border, ChainReport& report) {
  const int margin = margin_of(f, border, report);
  Frame e = f.without_planes();
  e.width += 2 * margin;
  e.height += 2 * margin;
  e.margin = margin;
  e.origin_x -= margin;
  e.origin_y -= margin;
  return e;
}

void repeat_coc(const Frame& f, const Frame& e, Rows rows, Quanta& coc) {
  const auto own = f.coc_quanta.host();
  repeat_rows(e, coc, rows, [&](std::size_t pixel) { return own[pixel]; });
}

void repeat_surfaces(const Frame& f, Border border, bool wants_data, Rows rows, Frame& e) {
  const auto depth = f.depth.host();
  repeat_rows(e, e.inverse, rows, [&](std::size_t pixel) { return inverse_of(depth[pixel]); });
  e.channels.resize(f.channels.size());
  for (std::size_t c = 0; c < f.channels.size(); ++c) {
    const auto own = f.channels[c].host();
    repeat_rows(e, e.channels[c], rows, [&](std::size_t pixel) { return own[pixel]; });
    if (border == Border::black) clear_margin(e, rows, e.channels[c].edit());
  }
  if (!wants_data) return;
  repeat_rows(e, e.data_of, rows,
              [](std::size_t pixel) { return static_cast<std::uint32_t>(pixel); });
}

}  // namespace defray
