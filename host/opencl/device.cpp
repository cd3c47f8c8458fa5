#include "opencl/device.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"
#include "base/text.h"
#include "opencl/driver_stacks.h"
#include "opencl/kernel_cache.h"

namespace defray {
namespace {

std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "GPU";
  if (type & CL_DEVICE_TYPE_CPU) return "CPU";
  return "accelerator";
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
  const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  DeviceInfo info;
  info.device = device;
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.platform = platform.getInfo<CL_PLATFORM_NAME>();
  info.version =
      device.getInfo<CL_DEVICE_VERSION>() + ", driver " + device.getInfo<CL_DRIVER_VERSION>();
  info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.max_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.global_memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.local_memory_bytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
  info.max_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.has_int64_atomics = extensions.find("cl_khr_int64_extended_atomics") != std::string::npos;
  const cl_device_type not_cpu = CL_DEVICE_TYPE_GPU | CL_DEVICE_TYPE_ACCELERATOR;
  info.shares_host_memory = (device.getInfo<CL_DEVICE_TYPE>() & not_cpu) == 0;
  const auto floats = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
  info.rounds_divisions = (floats & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.keeps_denormals = (floats & CL_FP_DENORM) != 0;
  info.has_double = extensions.find("cl_khr_fp64") != std::string::npos;
  // Oclgrind, which has no preference, looks at what CPUs run.
  info.prefers_vectors = device.getInfo<CL_DEVICE_PREFERRED_VECTOR_WIDTH_INT>() > 1 ||
                         contains_ignoring_case(info.name, "Oclgrind");
  if (contains_ignoring_case(info.name, "llvmpipe")) info.most_segments = std::size_t{1} << 12;
  return info;
}

std::string listing(const std::vector<DeviceInfo>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    text += fmt::format("{}{}: {} ({})", i ? "; " : "", i, devices[i].name, devices[i].platform);
  }
  return text;
}

bool is_pocl(const DeviceInfo& info) { return info.platform == "Portable Computing Language"; }

}  // namespace

std::vector<DeviceInfo> list_devices() {
  prepare_environment();
  const DriverStacks stacks;  // drivers start their threads at the first question
  std::vector<DeviceInfo> found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return found;  // the loader reports "no platform" as an error
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // and "no device" likewise
    }
    for (const cl::Device& device : devices) {
      try {
        found.push_back(describe(platform, device));
      } catch (const cl::Error&) {
        continue;  // one that cannot even tell its name is none
      }
    }
  }
  return found;
}

DeviceInfo select_device(const std::string& wanted, const std::string& otherwise) {
  const std::vector<DeviceInfo> devices = list_devices();
  if (devices.empty()) {
    fail(ErrorKind::device,
         "no OpenCL device found: install one (Debian: apt-get install pocl-opencl-icd){}",
         otherwise);
  }
  if (wanted.empty()) {
    const auto pocl = std::find_if(devices.begin(), devices.end(), is_pocl);
    return pocl != devices.end() ? *pocl : devices.front();
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (end == wanted.data() + wanted.size()) {
    if (error == std::errc() && index < devices.size()) return devices[index];
    fail(ErrorKind::device, "there is no OpenCL device {}; found: {}{}", wanted, listing(devices),
         otherwise);
  }
  std::vector<DeviceInfo> matches;
  for (const DeviceInfo& info : devices) {
    if (contains_ignoring_case(info.platform + " " + info.name, wanted)) matches.push_back(info);
  }
  if (matches.empty()) {
    fail(ErrorKind::device, "no OpenCL device is called '{}'; found: {}{}", wanted,
         listing(devices), otherwise);
  }
  if (matches.size() > 1) {
    fail(ErrorKind::device, "'{}' names more than one OpenCL device: {}", wanted, listing(matches));
  }
  return matches.front();
}

}  // namespace defray
