#include "methods/linear_band.h"

#include <cmath>

#include "base/error.h"
#include "methods/linear.h"

namespace defray {
namespace {

constexpr std::size_t planes_in = 5, planes_out = 4;

int squared(int i) { return i * i; }

std::size_t within(double distance) {
  return static_cast<std::size_t>(std::floor(distance * distance));
}

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

std::vector<BandRows> linear_bands(int width, int height, int reach, std::size_t memory_bytes) {
  const std::size_t least = linear_band_bytes(width, reach, 1);
  if (memory_bytes < least) {
    fail(ErrorKind::usage,
         "{} is {:.3g} MiB: one row of {} pixels with CoC radii up to {} px needs {} MiB",
         field("memory"), std::ldexp(static_cast<double>(memory_bytes), -20), width, reach,
         (least >> 20) + 1);
  }
  const std::size_t none = linear_band_bytes(width, reach, 0);
  return cut_into_bands(height, rows_that_fit(height, memory_bytes, none, least - none), reach);
}

std::vector<std::int32_t> row_reaches(const Plane& radius, const PaddedBand& band) {
  std::vector<std::int32_t> reaches;
  for (std::size_t row = 0; row < band.rows; ++row) {
    const auto begin = radius.begin() + static_cast<std::int64_t>(row * band.stride);
    const float largest = *std::max_element(begin, begin + static_cast<std::int64_t>(band.stride));
    reaches.push_back(static_cast<std::int32_t>(largest + 0.5f));
  }
  return reaches;
}

std::size_t linear_band_bytes(int width, int reach, int rows) {
  const std::size_t in_row = planes_in * sizeof(float) * PaddedBand::stride_for(width, reach);
  const std::size_t out_row = planes_out * sizeof(float) * PaddedBand::target_stride_for(width);
  return size(rows + 2 * reach) * in_row + size(rows) * out_row;
}

}  // namespace defray
