#pragma once
// Stacks of the threads that OpenCL drivers start.
#include <pthread.h>

#include <algorithm>
#include <cstddef>

namespace defray {

/// While it lives new threads get large stacks. PoCL keeps what the work-items of a work-group have
/// for themselves on its threads' stacks: 8 MiB, the usual, end at 1024 work-items of `fill`, and
/// the process with them. Only what is used takes memory.
class DriverStacks {
 public:
  DriverStacks() {
    pthread_getattr_default_np(&before_);
    std::size_t bytes = 0;
    pthread_attr_getstacksize(&before_, &bytes);
    pthread_attr_t large = before_;
    pthread_attr_setstacksize(&large, std::max(bytes, enough_bytes));
    pthread_setattr_default_np(&large);
  }
  ~DriverStacks() { pthread_setattr_default_np(&before_); }
  DriverStacks(const DriverStacks&) = delete;
  DriverStacks& operator=(const DriverStacks&) = delete;

 private:
  /// Enough for the kernels of every method in PoCL's largest work-groups, 4096 work-items; half of
  /// it was for those of the default.
  static constexpr std::size_t enough_bytes = std::size_t{128} << 20;
  pthread_attr_t before_{};
};

}  // namespace defray
