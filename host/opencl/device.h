#pragma once
// OpenCL devices: what there is, and choosing one.
#include <string>
#include <vector>

#include "defray/device.h"
#include "opencl/opencl.h"

namespace defray {

/// An OpenCL device.
struct DeviceInfo : DeviceProperties {
  cl::Device device;
  /// Segments of rays that a kernel may go through. Mesa's llvmpipe leaves a kernel's loops after
  /// 65536 turns in all, without a word; a segment takes several.
  std::size_t most_segments = std::size_t{1} << 16;
  /// Vectors in a work-item make it faster, as on CPUs; else they cost registers, and Mesa's
  /// llvmpipe two minutes to compile.
  bool prefers_vectors = true;
};

/// Every device of every platform, in platform order; empty where there is none.
std::vector<DeviceInfo> list_devices();

/// The device with this index, or the one whose "platform device" names contain `wanted`
/// (any case); an empty `wanted` is the first device, PoCL's before others.
/// Throws Error(device) when there is none, none matches, or several do; the message of the first
/// two ends in `otherwise`, what the user could do instead.
DeviceInfo select_device(const std::string& wanted, const std::string& otherwise = "");

}  // namespace defray
