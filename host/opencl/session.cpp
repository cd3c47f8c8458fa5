#include "opencl/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

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

std::string build_log(const cl::Program& program, const cl::Device& device) {
  try {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  } catch (const cl::Error&) {
    return "";
  }
}

/// PoCL 3.1 loses a race when several processes fill a cold kernel cache: clBuildProgram fails
/// with an empty log, and a new program succeeds. A real compile error has a log: no second try.
cl::Program build_program(const cl::Context& context, const DeviceInfo& info,
                          const std::string& source, const std::string& options) {
  constexpr int attempts = 8;
  for (int attempt = 1;; ++attempt) {
    cl::Program program(context, source);
    try {
      program.build({info.device}, options.c_str());
      return program;
    } catch (const cl::Error& error) {
      const std::string log = build_log(program, info.device);
      const bool is_real = log.find_first_not_of(" \n\t") != std::string::npos;
      if (is_real || attempt == attempts) {
        fail(ErrorKind::device, "clBuildProgram failed on {}: {} (options: {})\n{}", info.name,
             opencl_error_name(error.err()), options, log);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50 * attempt));
    }
  }
}

std::string build_options(const DeviceInfo& info, const SessionOptions& options,
                          bool int64_atomics) {
  std::string text = "-cl-std=CL1.2 " + options.build_options;
  if (int64_atomics) text += " -DDEFRAY_INT64_ATOMICS";
  if (options.math == Math::fast) return text + " -DDEFRAY_FAST_MATH -cl-fast-relaxed-math";
  // Without it OpenCL lets x / y be 2.5 ulp off, and sqrt 3.
  if (info.rounds_divisions) text += " -cl-fp32-correctly-rounded-divide-sqrt";
  return text;
}

}  // namespace

Session::Session(const DeviceInfo& info, const SessionOptions& options)
    : info_(info),
      int64_atomics_(options.use_int64_atomics && info.has_int64_atomics),
      measures_(options.measures) {
  context_ = checked(info_, "clCreateContext", [&] { return cl::Context(info.device); });
  queue_ = checked(info_, "clCreateCommandQueue", [&] {
    return cl::CommandQueue(context_, info.device, measures_ ? CL_QUEUE_PROFILING_ENABLE : 0);
  });
  const std::string source = kernel_source(options.files, options.substitutions);
  program_ = checked(info_, "clCreateProgramWithSource", [&] {
    return build_program(context_, info_, source, build_options(info_, options, int64_atomics_));
  });
  nothing_ = buffer(sizeof(cl_float4));
}

std::vector<std::string> Session::kernel_names() const {
  // Not CL_PROGRAM_KERNEL_NAMES: OpenCL 1.2 calls it optional without an online linker.
  return checked(info_, "clCreateKernelsInProgram", [&] {
    std::vector<cl::Kernel> kernels;
    cl::Program(program_).createKernels(&kernels);
    std::vector<std::string> names;
    for (const cl::Kernel& k : kernels) names.push_back(k.getInfo<CL_KERNEL_FUNCTION_NAME>());
    std::sort(names.begin(), names.end());
    return names;
  });
}

std::map<std::string, double> Session::take_kernel_seconds() {
  finish();
  std::map<std::string, double> seconds;
  for (const auto& [name, events] : events_) {
    for (const cl::Event& event : events) {
      const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
      seconds[name] += 1e-9 * static_cast<double>(end - start);
    }
  }
  events_.clear();
  return seconds;
}

void Session::set_work_group(std::size_t x, std::size_t y) {
  for (const Launch& launch : launch_table()) set_work_group(launch.kernel, x, y);
}

void Session::set_work_group(const std::string& kernel, std::size_t x, std::size_t y) {
  if (x * y > info_.max_work_group) {
    fail(ErrorKind::usage, "work-group {}x{} has {} work-items: {} allows at most {}", x, y, x * y,
         info_.name, info_.max_work_group);
  }
  if (x * y == 0) {
    groups_.erase(kernel);
  } else {
    groups_[kernel] = {x, y};
  }
}

cl::Buffer Session::buffer(std::size_t bytes) {
  if (bytes > info_.max_buffer_bytes) {
    fail(ErrorKind::device, "a buffer of {} MiB is needed: {} allows at most {} MiB; lower {}",
         bytes >> 20, info_.name, info_.max_buffer_bytes >> 20, field("memory"));
  }
  return checked(info_, "clCreateBuffer", [&] {
    cl::Buffer made(context_, CL_MEM_READ_WRITE, bytes);
    if (fill_) queue_.enqueueFillBuffer(made, *fill_, 0, bytes);
    return made;
  });
}

cl::Buffer Session::view(const void* data, std::size_t bytes) {
  if (bytes > info_.max_buffer_bytes) {
    fail(ErrorKind::device,
         "{} MiB of one image plane are within reach of a band: {} allows at most {} MiB a buffer; "
         "lower {}",
         bytes >> 20, info_.name, info_.max_buffer_bytes >> 20, field("max_coc_px"));
  }
  // A CPU works in host memory itself; anything else gets its copy once, here.
  const cl_mem_flags how = works_in_host_memory() ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
  if (!works_in_host_memory()) {
    ++traffic_->uploads;
    traffic_->bytes += bytes;
  }
  return checked(info_, "clCreateBuffer", [&] {
    // OpenCL's signature has no const; kernels only read it.
    return cl::Buffer(context_, CL_MEM_READ_WRITE | how, bytes, const_cast<void*>(data));
  });
}

DeviceBuffer* Session::here(DeviceValues* values) const {
  auto* const buffer = dynamic_cast<DeviceBuffer*>(values);
  return buffer && buffer->is_of(context_) ? buffer : nullptr;
}

std::unique_ptr<DeviceBuffer> Session::device_buffer(const cl::Buffer& buffer, std::size_t bytes) {
  return std::make_unique<DeviceBuffer>(context_, queue_, buffer, bytes, works_in_host_memory(),
                                        traffic_);
}

std::unique_ptr<DeviceBuffer> Session::hold(void* host, std::size_t bytes) {
  return device_buffer(view(host, bytes), bytes);
}

std::unique_ptr<DeviceBuffer> Session::room(void* host, std::size_t bytes) {
  if (!host) return device_buffer(buffer(bytes), bytes);
  if (fill_) std::memset(host, *fill_, bytes);
  return device_buffer(view(host, bytes), bytes);
}

void Session::read(const cl::Buffer& buffer, void* data, std::size_t bytes, std::size_t offset) {
  checked(info_, "clEnqueueReadBuffer",
          [&] { queue_.enqueueReadBuffer(buffer, CL_TRUE, offset, bytes, data); });
  ++traffic_->downloads;
  traffic_->bytes += bytes;
}

void Session::write(const cl::Buffer& buffer, const void* data, std::size_t bytes) {
  checked(info_, "clEnqueueWriteBuffer",
          [&] { queue_.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data); });
  ++traffic_->uploads;
  traffic_->bytes += bytes;
}

void Session::finish() {
  checked(info_, "clFinish", [&] { queue_.finish(); });
}

cl::Kernel& Session::kernel_of(const char* name) {
  const auto found = kernels_.find(name);
  if (found != kernels_.end()) return found->second;
  return checked(info_, std::string("clCreateKernel ") + name, [&]() -> cl::Kernel& {
    return kernels_.emplace(name, cl::Kernel(program_, name)).first->second;
  });
}

void Session::fail_argument(const char* name, cl_uint index, int code) const {
  fail(ErrorKind::device, "clSetKernelArg({}, {}) failed on {}: {}", name, index, info_.name,
       opencl_error_name(code));
}

void Session::enqueue(cl::Kernel& kernel, const char* name, const std::vector<std::size_t>& global,
                      const std::vector<std::size_t>& first) {
  const Launch& launch = launch_of(name);
  const auto set = groups_.find(name);
  const bool is_set = set != groups_.end();
  const std::size_t group[3] = {is_set ? set->second[0] : launch.group_x,
                                global.size() < 2 ? 1
                                : is_set          ? set->second[1]
                                                  : launch.group_y,
                                1};
  std::size_t padded[3] = {1, 1, 1}, offset[3] = {0, 0, 0};
  std::copy(first.begin(), first.end(), offset);
  for (std::size_t d = 0; d < global.size(); ++d) {
    padded[d] = (global[d] + group[d] - 1) / group[d] * group[d];
  }
  cl::Event event;
  checked(info_, std::string("clEnqueueNDRangeKernel ") + name, [&] {
    queue_.enqueueNDRangeKernel(kernel, cl::NDRange(offset[0], offset[1], offset[2]),
                                cl::NDRange(padded[0], padded[1], padded[2]),
                                cl::NDRange(group[0], group[1], group[2]), nullptr,
                                measures_ ? &event : nullptr);
  });
  if (measures_) events_[name].push_back(event);
}

std::string opencl_error_name(int code) {
  switch (code) {
#define DEFRAY_NAME(name) \
  case name:              \
    return #name
    DEFRAY_NAME(CL_DEVICE_NOT_FOUND);
    DEFRAY_NAME(CL_DEVICE_NOT_AVAILABLE);
    DEFRAY_NAME(CL_COMPILER_NOT_AVAILABLE);
    DEFRAY_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    DEFRAY_NAME(CL_OUT_OF_RESOURCES);
    DEFRAY_NAME(CL_OUT_OF_HOST_MEMORY);
    DEFRAY_NAME(CL_BUILD_PROGRAM_FAILURE);
    DEFRAY_NAME(CL_INVALID_VALUE);
    DEFRAY_NAME(CL_INVALID_DEVICE);
    DEFRAY_NAME(CL_INVALID_BUFFER_SIZE);
    DEFRAY_NAME(CL_INVALID_BUILD_OPTIONS);
    DEFRAY_NAME(CL_INVALID_KERNEL_NAME);
    DEFRAY_NAME(CL_INVALID_KERNEL_ARGS);
    DEFRAY_NAME(CL_INVALID_ARG_INDEX);
    DEFRAY_NAME(CL_INVALID_ARG_SIZE);
    DEFRAY_NAME(CL_INVALID_WORK_GROUP_SIZE);
    DEFRAY_NAME(CL_INVALID_WORK_ITEM_SIZE);
    DEFRAY_NAME(CL_INVALID_HOST_PTR);
#undef DEFRAY_NAME
    default:
      return fmt::format("OpenCL error {}", code);
  }
}

}  // namespace defray
