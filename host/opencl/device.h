#pragma once
// OpenCL devices: what there is, and choosing one.
#include <cstddef>
#include <string>
#include <vector>

#include "opencl/opencl.h"

namespace defray {

/// An OpenCL device and what matters to defray about it.
struct DeviceInfo {
  cl::Device device;
  std::string name;
  std::string platform;
  std::string version;  ///< OpenCL and driver version.
  std::string type;     ///< CPU, GPU, accelerator.
  std::size_t compute_units = 0;
  std::size_t max_work_group = 0;
  std::size_t global_memory_bytes = 0;
  std::size_t local_memory_bytes = 0;
  std::size_t max_buffer_bytes = 0;
  bool has_int64_atomics = false;  ///< Packed z-test; without it the scatter runs twice.
  bool has_double = false;
  bool rounds_divisions = false;    ///< x / y and sqrt(x) can be correctly rounded, if asked for.
  bool keeps_denormals = false;     ///< Otherwise floats below 2^-126 may count as 0.
  bool shares_host_memory = false;  ///< A CPU: buffers can be host memory itself.
};

/// Every device of every platform, in platform order; empty where there is none.
std::vector<DeviceInfo> list_devices();

/// The device with this index, or the one whose "platform device" names contain `wanted`
/// (any case); an empty `wanted` is the first device, PoCL's before others.
/// Throws Error(device) when there is none, none matches, or several do; the message of the first
/// two ends in `otherwise`, what the user could do instead.
DeviceInfo select_device(const std::string& wanted, const std::string& otherwise = "");

}  // namespace defray
