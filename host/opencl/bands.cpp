#include "opencl/bands.h"

#include <algorithm>

namespace defray {

std::vector<Band> cut_into_bands(int height, std::int64_t reach, int step, std::size_t row_bytes,
                                 std::size_t memory_bytes) {
  const std::int64_t end = height;
  // Windows begin up to a step earlier than they need to.
  const std::int64_t affordable =
      static_cast<std::int64_t>(memory_bytes / std::max<std::size_t>(1, row_bytes)) - 2 * reach -
      step;
  const std::int64_t rows = std::max<std::int64_t>(affordable / step, 1) * step;
  std::vector<Band> bands;
  for (std::int64_t y = 0; y < end; y += rows) {
    const std::int64_t window_y = std::max<std::int64_t>(0, y - reach) / step * step;
    const std::int64_t window_end = std::min(end, y + rows + reach);
    bands.push_back({static_cast<int>(y), static_cast<int>(std::min(rows, end - y)),
                     static_cast<int>(window_y), static_cast<int>(window_end - window_y)});
  }
  return bands;
}

cl::Buffer BandOnDevice::copy(const std::vector<Plane>& channels) const {
  std::vector<cl_float4> colours(count_);
  for (std::size_t c = 0; c < 4; ++c) {
    const Plane& plane = channels[std::min(c, channels.size() - 1)];
    for (std::size_t i = 0; i < count_; ++i) colours[i].s[c] = plane[first_ + i];
  }
  const cl::Buffer buffer = made<cl_float4>();
  session_.write(buffer, colours.data(), count_ * sizeof(cl_float4));
  return buffer;
}

void BandOnDevice::read(const cl::Buffer& buffer, std::vector<Plane>& planes) const {
  std::vector<cl_float4> colours(size(band_.rows) * stride_);
  session_.read(buffer, colours.data(), colours.size() * sizeof(cl_float4),
                size(band_.y - band_.window_y) * stride_ * sizeof(cl_float4));
  const std::size_t first = size(band_.y) * stride_;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < colours.size(); ++i) planes[c][first + i] = colours[i].s[c];
  }
}

}  // namespace defray
