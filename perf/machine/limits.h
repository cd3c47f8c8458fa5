#pragma once
// What a device can do at most, measured on it.
#include "opencl/device.h"

namespace defray::perf {

struct Limits {
  double bytes_a_second = 0;  ///< Read and written, by a copy of planes beyond every cache.
  /// Lens rays tested against a segment, from registers: subtracted, compared, noted. A ray of
  /// `rdb_gather` needs one such test at least.
  double tests_a_second = 0;
};

/// The best of `repetitions`.
Limits measure_limits(const DeviceInfo& info, int repetitions);

}  // namespace defray::perf
