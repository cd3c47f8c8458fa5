#include "opencl/bands.h"

#include <algorithm>

#include "opencl/launch_table.h"

namespace defray {
namespace {

/// For four arguments of one to four channels.
template <typename Channel>
std::array<cl::Buffer, 4> four(std::size_t count, const Channel& channel) {
  std::array<cl::Buffer, 4> buffers;
  for (std::size_t c = 0; c < 4; ++c) buffers[c] = c < count ? channel(c) : buffers[c - 1];
  return buffers;
}

}  // namespace

Band::Band(Session& session, const std::string& kernel, const Frame& frame, const BandRows& rows)
    : session_(session),
      kernel_(kernel),
      frame_(frame),
      rows_(rows),
      is_whole_(rows.rows == frame.height ||
                (session.works_in_host_memory() && rows.window_rows == frame.height)),
      stride_(size(frame.width) * size(frame.layers)),
      first_(size(rows.window_y) * stride_),
      count_(size(rows.window_rows) * stride_),
      total_(size(frame.height) * stride_) {}

std::array<cl::Buffer, 4> Band::in(const Planes& channels) {
  return four(channels.size(), [&](std::size_t c) { return in(channels[c]); });
}

std::array<cl::Buffer, 4> Band::out(Planes& channels, std::size_t count) {
  channels.resize(count);
  return four(count, [&](std::size_t c) { return out(channels[c]); });
}

std::array<cl::Buffer, 4> Band::in_out(Planes& channels) {
  return four(channels.size(), [&](std::size_t c) { return in_out(channels[c]); });
}

bool holds_planes(const Session& session, const char* kernel, const Frame& frame) {
  if (frame.surfaces() * sizeof(float) > session.info().max_buffer_bytes) return false;
  const bool is_band = frame.wanted_rows().count() < frame.height;
  if (is_band && !session.works_in_host_memory()) return false;
  const std::size_t bytes = frame.surfaces() * launch_of(kernel).bytes_a_surface;
  return session.works_in_host_memory() || bytes <= session.memory_bytes();
}

void for_each_band(Session& session, const char* kernel, const Frame& frame, std::int64_t reach_px,
                   const std::function<void(Band&)>& work, int step) {
  const Rows wanted = frame.wanted_rows();
  std::vector<BandRows> bands{{wanted.y, wanted.count(), 0, frame.height}};
  if (!holds_planes(session, kernel, frame)) {
    const Launch& launch = launch_of(kernel);
    const std::size_t row_bytes = size(frame.width) * size(frame.layers) * launch.bytes_a_surface;
    bands = cut_into_windows(wanted, frame.height, reach_px + launch.reach_px, step, row_bytes,
                             session.memory_bytes());
  }
  for (const BandRows& rows : bands) {
    Band band(session, kernel, frame, rows);
    work(band);
  }
}

}  // namespace defray
