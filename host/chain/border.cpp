#include "chain/border.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace defray {
namespace {

int margin_of(const PinholeFrame& f, Border border, DefocusReport& report) {
  if (border == Border::renormalise) return 0;
  std::int32_t largest = 0;
  const auto look = [&](int x, int y) {
    largest = std::max(largest, std::abs(f.coc_quanta[size(y) * size(f.width) + size(x)]));
  };
  for (int x = 0; x < f.width; ++x) look(x, 0), look(x, f.height - 1);
  for (int y = 0; y < f.height; ++y) look(0, y), look(f.width - 1, y);
  const int wanted = largest == 0 ? 0 : rdb_reach(largest);
  const int most = std::max(16, std::min(f.width, f.height) / 2);
  report.border_px = std::min(wanted, most);
  report.border_is_cut = wanted > most;
  return report.border_px;
}

/// `plane` with its edge repeated around it.
template <typename T>
std::vector<T> extended(const std::vector<T>& plane, int width, int height, int margin) {
  std::vector<T> out;
  out.reserve((size(width) + 2 * size(margin)) * (size(height) + 2 * size(margin)));
  for (int y = -margin; y < height + margin; ++y) {
    const T* row = &plane[size(std::clamp(y, 0, height - 1)) * size(width)];
    out.insert(out.end(), size(margin), row[0]);
    out.insert(out.end(), row, row + width);
    out.insert(out.end(), size(margin), row[width - 1]);
  }
  return out;
}

/// A line of front fragments from the frame's edge inwards, and outwards at negative places.
struct Line {
  const Fragments& fragments;
  std::size_t edge;
  std::ptrdiff_t inward;

  std::size_t at(int place) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(edge) + place * inward);
  }
  /// How many fragments from the edge on are of one surface, at most so many.
  int surface(int most) const {
    const auto& coc = fragments.coc_quanta;
    int count = 1;
    while (count < most &&
           std::abs(tame(coc[at(count)]) - tame(coc[at(count - 1)])) <= DEFRAY_JUMP_QUANTA)
      ++count;
    return count;
  }
};

void continue_line(const Line& line, int surface, int margin, Plane& plane) {
  const float edge = plane[line.at(0)];
  float sum = 0;  // of differences: one colour stays that colour
  for (int d = 0; d < margin; ++d) {
    if (d < surface) sum += plane[line.at(d)] - edge;
    const float colour = edge + sum / static_cast<float>(std::min(d + 1, surface));
    if (std::isfinite(colour)) plane[line.at(-1 - d)] = colour;
  }
}

}  // namespace

void continue_colours(const ExtendedFrame& e, Fragments& f) {
  const int m = e.margin;
  const auto go_on = [&](int x, int y, int step_x, int step_y, int length) {
    const auto inward = static_cast<std::ptrdiff_t>(step_y) * f.layers * f.width + step_x;
    const Line line{f, f.index(x, y, 0), inward};
    const int surface = line.surface(std::min(length, m));
    for (Plane& plane : f.channels) continue_line(line, surface, m, plane);
  };
  for (int y = m; m > 0 && y < e.height - m; ++y) {
    go_on(m, y, 1, 0, e.width - 2 * m);
    go_on(e.width - m - 1, y, -1, 0, e.width - 2 * m);
  }
  for (int x = 0; m > 0 && x < e.width; ++x) {
    go_on(x, m, 0, 1, e.height - 2 * m);
    go_on(x, e.height - m - 1, 0, -1, e.height - 2 * m);
  }
}

bool ExtendedFrame::is_in_margin(std::size_t pixel) const {
  const int x = static_cast<int>(pixel % size(width)), y = static_cast<int>(pixel / size(width));
  return x < margin || y < margin || x >= width - margin || y >= height - margin;
}

ExtendedFrame extend(const PinholeFrame& f, Border border, bool wants_data, DefocusReport& report) {
  const int margin = margin_of(f, border, report);
  ExtendedFrame e{f.width + 2 * margin, f.height + 2 * margin, margin, {}, {}, {}, {}};
  e.coc_quanta = extended(f.coc_quanta, f.width, f.height, margin);
  e.inverse = extended(f.depth, f.width, f.height, margin);
  for (float& z : e.inverse) z = std::isinf(z) ? 0.0f : 1.0f / z;
  for (const Plane& plane : f.channels) {
    e.channels.push_back(extended(plane, f.width, f.height, margin));
    for (std::size_t i = 0; border == Border::black && i < e.channels.back().size(); ++i) {
      if (e.is_in_margin(i)) e.channels.back()[i] = 0;
    }
  }
  if (wants_data) {
    std::vector<std::uint32_t> own(size(f.width) * size(f.height));
    std::iota(own.begin(), own.end(), 0u);
    e.data = extended(own, f.width, f.height, margin);
  }
  return e;
}

}  // namespace defray
