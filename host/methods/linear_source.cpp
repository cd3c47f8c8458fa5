#include "methods/linear_source.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "methods/linear.h"

namespace defray {
namespace {

int squared(int i) { return i * i; }

std::size_t within(double distance) {
  return static_cast<std::size_t>(std::floor(distance * distance));
}

/// A row of a frame with `reach` columns before it, and what is left of `stride` behind it.
struct Columns {
  std::size_t width, reach, stride;

  template <typename Value>
  void fill(float* row, const Value& value) const {
    for (std::size_t x = 0; x < width; ++x) row[reach + x] = value(x);
    std::fill(row, row + reach, row[reach]);
    std::fill(row + reach + width, row + stride, row[reach + width - 1]);
  }
};

}  // namespace

DiscNorms::DiscNorms(int reach) : count_(size(squared(reach + 1)) + 1), distance_(count_.size()) {
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const std::size_t d2 = size(x * x + y * y);
      if (d2 < count_.size()) ++count_[d2];
    }
  }
  for (std::size_t d2 = 1; d2 < count_.size(); ++d2) {
    distance_[d2] = distance_[d2 - 1] + count_[d2] * std::sqrt(static_cast<double>(d2));
    count_[d2] += count_[d2 - 1];
  }
}

double DiscNorms::operator()(double radius) const {
  const double outer = radius + 0.5, inner = std::max(radius - 0.5, 0.0);
  const std::size_t o = within(outer);
  if (radius < 0.5) return count_[o] * outer - distance_[o];
  const std::size_t i = within(inner);
  return count_[i] + (count_[o] - count_[i]) * outer - (distance_[o] - distance_[i]);
}

LinearSource::LinearSource(const Frame& frame, const BandRows& rows, int reach, std::size_t stride,
                           const DiscNorms& norm)
    : radius(size(rows.window_rows) * stride),
      scaled(frame.channels.size(), Plane(radius.size())),
      row_reach(size(rows.window_rows)) {
  const std::size_t width = size(frame.width);
  const std::int32_t* const coc_quanta = frame.coc_quanta.begin();
  std::vector<const float*> channels;
  for (const Values<float>& channel : frame.channels) channels.push_back(channel.begin());
  parallel_for(rows.window_rows, [&](int row) {
    const std::size_t from = size(rows.window_y + row) * width, to = size(row) * stride;
    Plane twice(width);
    float largest = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const float r = radius_px(coc_quanta[from + x]);
      twice[x] = static_cast<float>(2 * norm(static_cast<double>(r)));
      largest = std::max(largest, r);
    }
    row_reach[size(row)] = static_cast<std::int32_t>(largest + 0.5f);
    const Columns columns{width, size(reach), stride};
    columns.fill(&radius[to], [&](std::size_t x) { return radius_px(coc_quanta[from + x]); });
    for (std::size_t c = 0; c < scaled.size(); ++c) {
      columns.fill(&scaled[c][to], [&](std::size_t x) { return channels[c][from + x] / twice[x]; });
    }
  });
}

}  // namespace defray
