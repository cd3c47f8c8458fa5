#pragma once
// What the kernels of the ray distribution buffer write for a band of rows, and what comes after
// the means: nearest hits.
#include <array>

#include "frame/backend.h"
#include "opencl/session.h"
#include "rdb/rdb.h"

namespace defray {

/// Source planes on the device, of the window or of all rows.
struct RayWindow {
  cl::Buffer coc, depth, coverage, data_of;
  std::array<cl::Buffer, 4> channels;
};

/// Targets that a work-item of the kernels on lanes.clh takes at once.
struct Lanes {
  std::size_t across, down;

  explicit Lanes(const Session& session)
      : across(session.uses_vectors() ? DEFRAY_RAY_RUN : 1),
        down(session.uses_vectors() ? DEFRAY_RAY_ROWS : 1) {}

  /// Work-items along so many targets.
  std::size_t over_columns(std::size_t count) const { return (count + across - 1) / across; }
  std::size_t over_rows(std::size_t count) const { return (count + down - 1) / down; }
};

/// A buffer that is used again where it is large enough: new memory costs as much as what kernels
/// do in it.
class KeptBuffer {
 public:
  cl::Buffer take(Session& session, std::size_t bytes) {
    if (bytes > bytes_) buffer_ = session.buffer(bytes), bytes_ = bytes;
    return buffer_;
  }

 private:
  cl::Buffer buffer_;
  std::size_t bytes_ = 0;
};

/// A part of the result for kernels to change: itself, or a copy on the device.
template <typename T>
cl::Buffer lent(Session& session, T* values, std::size_t count) {
  if (session.works_in_host_memory()) return session.change_view(values, count * sizeof(T));
  const cl::Buffer buffer = session.buffer(count * sizeof(T));
  session.write(buffer, values, count * sizeof(T));
  return buffer;
}

class RayBuffers {
 public:
  /// For bands of at most so many pixels, each with so many bytes of winners in `winners`. All
  /// must stay alive.
  RayBuffers(Session& session, const Frame& frame, const RayPlan& plan, std::size_t pixels,
             std::size_t winner_bytes, KeptBuffer& winners);

  /// What does not change from band to band.
  DefrayRdbParams params() const;

  /// Looks for the nearest hit among the winners, if the plan wants it.
  void find_nearest(const DefrayRdbParams& p, const RayWindow& window);

  /// From here on kernels write a band's means, and what was seen: where the device works in host
  /// memory, into the result itself.
  void begin(const DefrayRdbParams& p, RayResult& out);

  /// The band's part of the result is there.
  void read(const DefrayRdbParams& p, RayResult& out);

  cl::Buffer lens, landing_radii, rim_x, rim_y, winner, seen;
  std::array<cl::Buffer, 4> means;  ///< Planes; kernels write missing channels too.

 private:
  /// Index of the band's first pixel in the result.
  std::size_t first_of(const DefrayRdbParams& p) const;

  Session& session_;
  const Frame& frame_;
  const RayPlan& plan_;
  cl::Buffer nearest_;
};

}  // namespace defray
