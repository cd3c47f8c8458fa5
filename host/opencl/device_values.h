#pragma once
// A buffer that is the device's side of values.
#include <atomic>
#include <memory>

#include "frame/values.h"
#include "opencl/opencl.h"

namespace defray {

/// Whole planes that went from host memory to a device's own, and back. None do where a device
/// works in host memory.
struct Traffic {
  std::atomic<std::size_t> uploads = 0, downloads = 0;
  std::atomic<std::size_t> bytes = 0;  ///< Of both.
  std::atomic<std::size_t> made = 0;   ///< Bytes of all buffers made on the device.
};

class DeviceBuffer : public DeviceValues {
 public:
  DeviceBuffer(cl::Context context, cl::CommandQueue queue, cl::Buffer buffer, std::size_t bytes,
               bool works_in_host_memory, std::shared_ptr<Traffic> traffic);
  ~DeviceBuffer() override;

  /// Throws Error(device).
  void fetch(void* host) override;

  /// For kernels: what was mapped for the host is given back.
  const cl::Buffer& use();

  bool is_of(const cl::Context& context) const { return context_() == context(); }

 private:
  void unmap();

  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Buffer buffer_;
  std::size_t bytes_;
  bool works_in_host_memory_;
  void* mapped_ = nullptr;
  std::shared_ptr<Traffic> traffic_;
};

}  // namespace defray
