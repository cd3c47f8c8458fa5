#include "opencl/session.h"

#include <algorithm>
#include <cstring>

#include "opencl/launch_table.h"
#include "opencl/opencl_error.h"
#include "opencl/program.h"

namespace defray {
Session::Session(const DeviceInfo& info, const SessionOptions& options)
    : info_(info),
      int64_atomics_(options.use_int64_atomics && info.has_int64_atomics),
      vectors_(options.use_vectors && info.prefers_vectors),
      measures_(options.measures) {
  context_ = checked(info_, "clCreateContext", [&] { return cl::Context(info.device); });
  queue_ = checked(info_, "clCreateCommandQueue", [&] {
    return cl::CommandQueue(context_, info.device, measures_ ? CL_QUEUE_PROFILING_ENABLE : 0);
  });
  program_ = build_program(context_, info_, options, int64_atomics_);
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
  checked(info_, "clGetEventProfilingInfo", [&] {
    for (const auto& [name, events] : events_) {
      for (const cl::Event& event : events) {
        const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        seconds[name] += 1e-9 * static_cast<double>(end - start);
      }
    }
  });
  events_.clear();
  return seconds;
}

void Session::set_work_group(std::size_t x, std::size_t y) {
  for (const Launch& launch : launch_table()) set_work_group(launch.kernel, x, y);
}

void Session::set_work_group(const std::string& kernel, std::size_t x, std::size_t y) {
  if ((x == 0) != (y == 0)) {
    fail(ErrorKind::usage, "work-group {}x{}: either both are 0, for the kernel's own, or none", x,
         y);
  }
  if (x > info_.max_work_group || y > info_.max_work_group || x * y > info_.max_work_group) {
    fail(ErrorKind::usage, "work-group {}x{} has too many work-items: {} allows at most {}", x, y,
         info_.name, info_.max_work_group);
  }
  if (x * y == 0) {
    groups_.erase(kernel);
  } else {
    groups_[kernel] = {x, y};
  }
}

void Session::set_tuned(std::map<std::string, std::array<std::size_t, 2>> groups) {
  tuned_ = std::move(groups);
}

std::map<std::string, std::array<std::size_t, 2>> Session::tuned() const {
  auto used = tuned_;
  for (const auto& [kernel, group] : groups_) used.erase(kernel);
  return used;
}

std::array<std::size_t, 2> Session::group_of(const std::string& name) const {
  if (const auto set = groups_.find(name); set != groups_.end()) return set->second;
  const auto tuned = tuned_.find(name);
  const WorkGroup own = launch_of(name).group_on(info_.is_gpu());
  auto [x, y] = tuned != tuned_.end() ? tuned->second : std::array{own.x, own.y};
  const auto known = most_work_items_.find(name);
  const std::size_t most = known != most_work_items_.end() ? known->second : info_.max_work_group;
  while (x * std::max<std::size_t>(y, 1) > most) (x > y ? x : y) /= 2;
  return {x, y};
}

cl::Buffer Session::buffer(std::size_t bytes) {
  if (bytes > info_.max_buffer_bytes) {
    fail(ErrorKind::device, "a buffer of {} MiB is needed: {} allows at most {} MiB; lower {}",
         bytes >> 20, info_.name, info_.max_buffer_bytes >> 20, field("memory"));
  }
  return checked(info_, "clCreateBuffer", [&] {
    cl::Buffer made(context_, CL_MEM_READ_WRITE, bytes);
    traffic_->made += bytes;
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
    traffic_->made += bytes;
  }
  return checked(info_, "clCreateBuffer", [&] {
    // OpenCL's signature has no const; kernels only read it.
    return cl::Buffer(context_, CL_MEM_READ_WRITE | how, bytes, const_cast<void*>(data));
  });
}

cl::Buffer Session::write_view(void* data, std::size_t bytes) {
  if (fill_) std::memset(data, *fill_, bytes);
  return view(data, bytes);
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
  return device_buffer(host ? write_view(host, bytes) : buffer(bytes), bytes);
}

const void* Session::map(const cl::Buffer& buffer, std::size_t bytes) {
  if (!works_in_host_memory()) {
    ++traffic_->downloads;
    traffic_->bytes += bytes;
  }
  return checked(info_, "clEnqueueMapBuffer",
                 [&] { return queue_.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes); });
}

void Session::unmap(const cl::Buffer& buffer, const void* mapped) {
  checked(info_, "clEnqueueUnmapMemObject",
          [&] { queue_.enqueueUnmapMemObject(buffer, const_cast<void*>(mapped)); });
}

void Session::clear(const cl::Buffer& buffer, std::size_t bytes) {
  checked(info_, "clEnqueueFillBuffer",
          [&] { queue_.enqueueFillBuffer(buffer, cl_uchar{0}, 0, bytes); });
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
    const cl::Kernel kernel(program_, name);
    most_work_items_[name] = std::min(
        info_.max_work_group, kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(info_.device));
    return kernels_.emplace(name, kernel).first->second;
  });
}

void Session::fail_argument(const char* name, cl_uint index, int code) const {
  fail(ErrorKind::device, "clSetKernelArg({}, {}) failed on {}: {}", name, index, info_.name,
       opencl_error_name(code));
}

void Session::enqueue(cl::Kernel& kernel, const char* name, const std::vector<std::size_t>& global,
                      const std::vector<std::size_t>& first) {
  const auto [x, y] = group_of(name);
  const std::size_t group[3] = {x, global.size() < 2 ? 1 : y, 1};
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
  if (!measures_) return;
  events_[name].push_back(event);
  note_bytes(name);
}

void Session::note_bytes(const char* name) {
  std::size_t bytes = 0;
  for (const cl_mem buffer : given_) bytes += cl::Buffer(buffer, true).getInfo<CL_MEM_SIZE>();
  kernel_bytes_[name] = std::max(kernel_bytes_[name], bytes);
}

}  // namespace defray
