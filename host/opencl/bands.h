#pragma once
// Rows of a frame that are worked out together. A device that works in host memory, or has room for
// whole planes, takes the frame in one band, and planes stay where they are; else bands go there
// with the rows that they depend on.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "defray/report.h"
#include "frame/band_rows.h"
#include "frame/frame.h"
#include "opencl/launch_table.h"
#include "opencl/session.h"

namespace defray {

/// One band at work. Planes are [height][stride], or [window_rows][stride] of them on the device;
/// the kernel runs over the band's rows alone.
class Band {
 public:
  Band(Session& session, const std::string& kernel, const Frame& frame, const BandRows& rows,
       const Progress& progress = {});

  const BandRows& rows() const { return rows_; }

  /// The band's own rows as their own window: for kernels that write no others.
  Band own() const;

  /// Index of the window's first value in a plane.
  std::size_t first() const { return first_; }

  template <typename T>
  cl::Buffer in(const Values<T>& plane) {
    if (is_whole_ || plane.empty()) return session_.in(plane);
    return session_.view(&plane[first_], count_ * sizeof(T));
  }

  /// Four channels: a missing one repeats the last.
  std::array<cl::Buffer, 4> in(const Planes& channels);

  /// A plane of the frame's tiles, the window's: [rows of tiles][tiles_x].
  template <typename T>
  cl::Buffer tiles(const Values<T>& plane, int tiles_x, int tile_px) {
    const std::size_t first = size(rows_.window_y / tile_px) * size(tiles_x);
    const int rows = (rows_.window_rows + tile_px - 1) / tile_px;
    const std::size_t count = std::min(size(rows) * size(tiles_x), plane.size() - first);
    return session_.view(&plane[first], count * sizeof(T));
  }

  /// The band's rows of a plane of the frame, to be written.
  template <typename T>
  cl::Buffer out(Values<T>& plane) {
    if (is_whole_ && plane.empty()) return session_.out(plane, count_);
    if (is_whole_) return session_.in_out(plane);  // what others have written there stays
    if (plane.empty()) plane = Values<T>::room(total_);
    const cl::Buffer made = session_.buffer(count_ * sizeof(T));
    read_back(made, plane);
    return made;
  }
  std::array<cl::Buffer, 4> out(Planes& channels, std::size_t count);

  /// The band's rows of a plane, to be changed.
  template <typename T>
  cl::Buffer in_out(Values<T>& plane) {
    if (is_whole_) return session_.in_out(plane);
    const cl::Buffer made = session_.buffer(count_ * sizeof(T));
    session_.write(made, &plane[first_], count_ * sizeof(T));
    read_back(made, plane);
    return made;
  }
  std::array<cl::Buffer, 4> in_out(Planes& channels);

  /// Runs the kernel over the band's rows, as many at once as its launch has; those of a frame of
  /// layers are [row][layer].
  template <typename... Args>
  void launch(const Args&... args) {
    const Launch& launch = launch_of(kernel_);
    const std::size_t layers = size(frame_.layers);
    const std::size_t runs = (size(frame_.width) + launch.run_px - 1) / launch.run_px;
    const int most = launch.rows_at_once > 0 ? launch.rows_at_once : rows_.rows;
    for (int row = 0; row < rows_.rows; row += most) {
      const int count = std::min(most, rows_.rows - row);
      const std::size_t first = size(rows_.y - rows_.window_y + row) * layers;
      session_.launch_from({0, first}, kernel_.c_str(), {runs, size(count) * layers}, args...);
      report(row + count);
    }
    collect();
  }

  /// What kernels have written goes where `out` and `in_out` were told; `launch` does it.
  void collect() {
    for (const auto& read : reads_) read();
  }

 private:
  template <typename T>
  void read_back(const cl::Buffer& buffer, Values<T>& plane) {
    reads_.push_back([this, buffer, &plane] {
      const std::size_t at = size(rows_.y) * stride_, before = size(rows_.y - rows_.window_y);
      session_.read(buffer, &plane.edit()[at], size(rows_.rows) * stride_ * sizeof(T),
                    before * stride_ * sizeof(T));
    });
  }

  /// The share of the frame that is done with so many of the band's rows.
  void report(int done) const;

  Session& session_;
  std::string kernel_;
  const Frame& frame_;
  BandRows rows_;
  Progress progress_;
  bool is_whole_;
  std::size_t stride_, first_, count_, total_;
  std::vector<std::function<void()>> reads_;  ///< After the launch.
};

/// Whether the device holds the kernel's planes of a whole frame: in one band, where they stay.
/// `reach_px` rows around a band count beside those of the launch table.
bool holds_planes(const Session& session, const char* kernel, const Frame& frame,
                  std::int64_t reach_px = 0);

/// What bands of so many rows take by the launch table, bytes.
std::size_t band_bytes(const char* kernel, const Frame& frame, std::int64_t reach_px, int rows);

/// Throws Error(usage) where the frame has to be cut and not even one row fits the memory.
void require_row(const Session& session, const char* kernel, const Frame& frame,
                 std::int64_t reach_px);

/// A kernel over a frame's wanted rows: `work` launches it once a band. Bands begin at multiples of
/// `step` rows.
void for_each_band(Session& session, const char* kernel, const Frame& frame, std::int64_t reach_px,
                   const std::function<void(Band&)>& work, int step = 1,
                   const Progress& progress = {});

}  // namespace defray
