#include "opencl/device_values.h"

#include "opencl/opencl_error.h"

namespace defray {
namespace {

[[noreturn]] void fail_on(const cl::Error& error) {
  fail(ErrorKind::device, "{} failed: {}", error.what(), opencl_error_name(error.err()));
}

}  // namespace

DeviceBuffer::DeviceBuffer(cl::Context context, cl::CommandQueue queue, cl::Buffer buffer,
                           std::size_t bytes, bool works_in_host_memory,
                           std::shared_ptr<Traffic> traffic)
    : context_(std::move(context)),
      queue_(std::move(queue)),
      buffer_(std::move(buffer)),
      bytes_(bytes),
      works_in_host_memory_(works_in_host_memory),
      traffic_(std::move(traffic)) {}

DeviceBuffer::~DeviceBuffer() {
  try {
    unmap();
    // The host memory that kernels work in may go right after this.
    if (works_in_host_memory_) queue_.finish();
  } catch (const cl::Error&) {
    // Nothing that could be done about it here; the next call on the device says so.
  }
}

void DeviceBuffer::fetch(void* host) {
  try {
    if (works_in_host_memory_) {
      if (!mapped_) mapped_ = queue_.enqueueMapBuffer(buffer_, CL_TRUE, CL_MAP_READ, 0, bytes_);
      return;
    }
    queue_.enqueueReadBuffer(buffer_, CL_TRUE, 0, bytes_, host);
    ++traffic_->downloads;
    traffic_->bytes += bytes_;
  } catch (const cl::Error& error) {
    fail_on(error);
  }
}

const cl::Buffer& DeviceBuffer::use() {
  try {
    unmap();
  } catch (const cl::Error& error) {
    fail_on(error);
  }
  return buffer_;
}

void DeviceBuffer::unmap() {
  if (!mapped_) return;
  queue_.enqueueUnmapMemObject(buffer_, mapped_);
  mapped_ = nullptr;
}

}  // namespace defray
