#include "chain/border.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>

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

/// `plane` with its edge repeated around it.
template <typename T>
std::vector<T> repeated(std::span<const T> plane, int width, int height, int margin) {
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
  for (int y = m; y < f.height - m; ++y) {
    go_on(m, y, 1, 0, f.width - 2 * m);
    go_on(f.width - m - 1, y, -1, 0, f.width - 2 * m);
  }
  for (int x = 0; x < f.width; ++x) {
    go_on(x, m, 0, 1, f.height - 2 * m);
    go_on(x, f.height - m - 1, 0, -1, f.height - 2 * m);
  }
}

Frame extended(const Frame& f, Border border, bool wants_data, ChainReport& report) {
  const int margin = margin_of(f, border, report);
  Frame e = f.without_planes();
  e.width += 2 * margin;
  e.height += 2 * margin;
  e.margin = margin;
  e.origin_x -= margin;
  e.origin_y -= margin;
  e.coc_quanta = repeated(f.coc_quanta.host(), f.width, f.height, margin);
  Plane inverse = repeated(f.depth.host(), f.width, f.height, margin);
  for (float& z : inverse) z = std::isinf(z) ? 0.0f : 1.0f / z;
  e.inverse = std::move(inverse);
  for (const Values<float>& channel : f.channels) {
    Plane plane = repeated(channel.host(), f.width, f.height, margin);
    for (std::size_t i = 0; border == Border::black && i < plane.size(); ++i) {
      if (e.is_in_margin(i)) plane[i] = 0;
    }
    e.channels.emplace_back(std::move(plane));
  }
  if (wants_data) {
    std::vector<std::uint32_t> own(f.pixels());
    std::iota(own.begin(), own.end(), 0u);
    e.data_of = repeated(std::span<const std::uint32_t>(own), f.width, f.height, margin);
  }
  return e;
}

}  // namespace defray
