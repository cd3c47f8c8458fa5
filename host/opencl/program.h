#pragma once
// The kernels, compiled for a device.
#include "opencl/device.h"
#include "opencl/session_options.h"

namespace defray {

/// Throws Error(device) with the compiler's log.
cl::Program build_program(const cl::Context& context, const DeviceInfo& info,
                          const SessionOptions& options, bool int64_atomics);

}  // namespace defray
