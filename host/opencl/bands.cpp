#include "opencl/bands.h"

#include <cmath>

#include "base/error.h"

namespace defray {
namespace {

RowBytes row_bytes(const Launch& launch, const Frame& frame, std::int64_t reach) {
  const std::size_t width = size(frame.width);
  return {launch.row_values(width, reach) * size(frame.layers) * launch.bytes_a_surface,
          width * launch.bytes_a_target};
}

}  // namespace

Band::Band(Session& session, const std::string& kernel, const Frame& frame, const BandRows& rows,
           const Progress& progress)
    : session_(session),
      kernel_(kernel),
      frame_(frame),
      rows_(rows),
      progress_(progress),
      is_whole_(rows.rows == frame.height ||
                (session.works_in_host_memory() && rows.window_rows == frame.height)),
      stride_(size(frame.width) * size(frame.layers)),
      first_(size(rows.window_y) * stride_),
      count_(size(rows.window_rows) * stride_),
      total_(size(frame.height) * stride_) {}

Band Band::own() const {
  return {session_, kernel_, frame_, {rows_.y, rows_.rows, rows_.y, rows_.rows}, progress_};
}

void Band::report(int done) const {
  if (!progress_) return;
  session_.finish();
  const Rows wanted = frame_.wanted_rows();
  progress_(static_cast<double>(rows_.y + done - wanted.y) / wanted.count());
}

std::array<cl::Buffer, 4> Band::in(const Planes& channels) {
  return four_channels(channels.size(), [&](std::size_t c) { return in(channels[c]); });
}

std::array<cl::Buffer, 4> Band::out(Planes& channels, std::size_t count) {
  channels.resize(count);
  return four_channels(count, [&](std::size_t c) { return out(channels[c]); });
}

std::array<cl::Buffer, 4> Band::in_out(Planes& channels) {
  return four_channels(channels.size(), [&](std::size_t c) { return in_out(channels[c]); });
}

bool holds_planes(const Session& session, const char* kernel, const Frame& frame,
                  std::int64_t reach_px) {
  const Launch& launch = launch_of(kernel);
  const std::size_t values = launch.row_values(size(frame.width), reach_px + launch.reach_px) *
                             size(frame.height) * size(frame.layers);
  if (values * launch.bytes_a_value > session.info().max_buffer_bytes) return false;
  const bool makes_copies = !session.works_in_host_memory() || launch.reads_padded;
  if (!makes_copies) return true;
  const bool is_band = frame.wanted_rows().count() < frame.height;
  return !is_band && band_bytes(kernel, frame, reach_px, frame.height) <= session.memory_bytes();
}

std::size_t band_bytes(const char* kernel, const Frame& frame, std::int64_t reach_px, int rows) {
  const Launch& launch = launch_of(kernel);
  const std::int64_t reach = reach_px + launch.reach_px;
  return row_bytes(launch, frame, reach).of_band(rows, 2 * reach, frame.height);
}

void require_row(const Session& session, const char* kernel, const Frame& frame,
                 std::int64_t reach_px) {
  const std::size_t least = band_bytes(kernel, frame, reach_px, 1);
  if (holds_planes(session, kernel, frame, reach_px) || session.memory_bytes() >= least) return;
  fail(ErrorKind::usage,
       "{} is {:.3g} MiB: one row of {} pixels with CoC radii up to {} px needs {} MiB",
       field("memory"), std::ldexp(static_cast<double>(session.memory_bytes()), -20), frame.width,
       reach_px, (least >> 20) + 1);
}

void for_each_band(Session& session, const char* kernel, const Frame& frame, std::int64_t reach_px,
                   const std::function<void(Band&)>& work, int step, const Progress& progress) {
  const Rows wanted = frame.wanted_rows();
  std::vector<BandRows> bands{{wanted.y, wanted.count(), 0, frame.height}};
  if (!holds_planes(session, kernel, frame, reach_px)) {
    const Launch& launch = launch_of(kernel);
    const std::int64_t reach = reach_px + launch.reach_px;
    bands = cut_into_windows(wanted, frame.height, reach, step, row_bytes(launch, frame, reach),
                             session.memory_bytes());
  }
  for (const BandRows& rows : bands) {
    Band band(session, kernel, frame, rows, progress);
    work(band);
  }
}

}  // namespace defray
