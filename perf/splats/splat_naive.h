#pragma once
// Splatting as it is written down first: a work-item a splat, which puts its fragments on lists of
// its pixels (an A-buffer), and then one a pixel, which sorts its list. To compare with.
#include "opencl/device.h"
#include "splat/splats.h"

namespace defray::perf {

class NaiveSplats {
 public:
  explicit NaiveSplats(const DeviceInfo& info);

  /// R G B A of splats in order, and the seconds on the device, the best of `repetitions`. Throws
  /// Error(internal) where a pixel has more fragments than fit.
  std::vector<Plane> draw(const Splats& splats, const DefraySplatParams& params, int repetitions,
                          double& seconds);

 private:
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
};

}  // namespace defray::perf
