#pragma once
// Rows of a frame that are worked out together, so that a device holds no more than a budget.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lens/coc.h"
#include "opencl/session.h"

namespace defray {

/// Rows that are worked out, and those that they depend on, themselves among them.
struct Band {
  int y, rows;
  int window_y, window_rows;
};

/// Bands from the top with windows of `reach` rows more on each side that take at most
/// `memory_bytes`. Bands and windows begin at multiples of `step` rows: no band has fewer, whatever
/// the budget.
std::vector<Band> cut_into_bands(int height, std::int64_t reach, int step, std::size_t row_bytes,
                                 std::size_t memory_bytes);

/// A band on a device. Planes are [height][stride] on the host, [window_rows][stride] there;
/// kernels run over the band's rows alone.
class BandOnDevice {
 public:
  BandOnDevice(Session& session, const Band& band, std::size_t stride)
      : session_(session),
        band_(band),
        stride_(stride),
        first_(size(band.window_y) * stride),
        count_(size(band.window_rows) * stride) {}

  std::size_t stride() const { return stride_; }
  std::size_t first() const { return first_; }  ///< Index of the window's first value.

  template <typename T>
  cl::Buffer view(const std::vector<T>& plane) const {
    return session_.view(&plane[first_], count_ * sizeof(T));
  }
  cl::Buffer picture(const Plane& plane) const { return session_.picture(&plane[first_], count_); }

  template <typename T>
  cl::Buffer made() const {
    return session_.buffer(count_ * sizeof(T));
  }
  template <typename T>
  cl::Buffer copy(const std::vector<T>& plane) const {
    const cl::Buffer buffer = made<T>();
    session_.write(buffer, &plane[first_], count_ * sizeof(T));
    return buffer;
  }

  /// float4 of 1 to 4 channels; a missing one repeats the last.
  cl::Buffer copy(const std::vector<Plane>& channels) const;

  /// Runs a kernel over the band; `layers` of its rows are one of the picture's.
  template <typename... Args>
  void launch(const char* kernel, int layers, const Args&... args) {
    const std::size_t first = size(band_.y - band_.window_y) * size(layers);
    session_.launch_from({0, first}, kernel, DEFRAY_STAGE_GROUP,
                         {stride_ / size(layers), size(band_.rows) * size(layers)}, args...);
  }

  /// The band's rows, in their place in a plane of the frame.
  template <typename T>
  void read(const cl::Buffer& buffer, std::vector<T>& plane) const {
    session_.read(buffer, &plane[size(band_.y) * stride_], size(band_.rows) * stride_ * sizeof(T),
                  size(band_.y - band_.window_y) * stride_ * sizeof(T));
  }
  /// The same from float4, as many channels as there are planes.
  void read(const cl::Buffer& buffer, std::vector<Plane>& planes) const;

 private:
  Session& session_;
  Band band_;
  std::size_t stride_, first_, count_;
};

/// Four channels of a band: a missing one repeats the last.
struct ChannelsOnDevice {
  cl::Buffer of[4];
  ChannelsOnDevice(const BandOnDevice& band, const std::vector<Plane>& planes) {
    for (std::size_t c = 0; c < 4; ++c) {
      of[c] = c < planes.size() ? band.picture(planes[c]) : of[c - 1];
    }
  }
};

}  // namespace defray
