#pragma once
// OpenCL's errors as ours.
#include <string>

#include "base/error.h"
#include "opencl/device.h"

namespace defray {

/// "CL_INVALID_VALUE" for -30, and so on; "OpenCL error N" for codes outside OpenCL 1.2.
std::string opencl_error_name(int code);

/// Runs `call`; a cl::Error becomes an Error that says what failed.
template <typename Call>
decltype(auto) checked(const DeviceInfo& info, const std::string& what, Call&& call) {
  try {
    return call();
  } catch (const cl::Error& error) {
    fail(ErrorKind::device, "{} failed on {}: {} ({})", what, info.name,
         opencl_error_name(error.err()), error.what());
  }
}

}  // namespace defray
