#pragma once
// One device, made ready: context, queue and the kernels, built once.
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "defray/device.h"
#include "frame/frame.h"
#include "opencl/device.h"
#include "opencl/device_values.h"
#include "opencl/session_options.h"

namespace defray {

/// Runs kernels on one device. Every failure is an Error(device) that names the call and the
/// OpenCL error; a failed build carries the compiler's log.
class Session {
 public:
  explicit Session(const DeviceInfo& info, const SessionOptions& options = {});

  const DeviceInfo& info() const { return info_; }
  bool has_int64_atomics() const { return int64_atomics_; }
  /// Whether kernels are built with vectors in a work-item (kernels/base/lanes.clh).
  bool uses_vectors() const { return vectors_; }

  /// Names of all kernels of the program, sorted.
  std::vector<std::string> kernel_names() const;

  /// Seconds that each kernel has run since the last call. Needs SessionOptions::measures.
  std::map<std::string, double> take_kernel_seconds();

  /// Bytes of all buffers that a launch of each kernel was given, each once: the most of its
  /// launches. Needs SessionOptions::measures.
  const std::map<std::string, std::size_t>& kernel_bytes() const { return kernel_bytes_; }

  /// Work-group {x, y} of every kernel, or of one; {0, 0}: as tuned, or as the launch table has it.
  void set_work_group(std::size_t x, std::size_t y);
  void set_work_group(const std::string& kernel, std::size_t x, std::size_t y);

  /// Work-groups that are used where none is set: instead of those that were here before.
  void set_tuned(std::map<std::string, std::array<std::size_t, 2>> groups);
  /// Those of them that are used: none is set.
  std::map<std::string, std::array<std::size_t, 2>> tuned() const;

  /// What a kernel is launched with: as set; or as tuned, or as the launch table has it, halved
  /// until the device takes so many work-items, of this kernel, once it is made.
  std::array<std::size_t, 2> group_of(const std::string& name) const;

  /// What is made on the device for a stage fits so much, unless a row with the rows that it looks
  /// at is more already.
  void set_memory(std::size_t bytes) { memory_bytes_ = bytes; }
  std::size_t memory_bytes() const { return std::min(memory_bytes_, info_.max_buffer_bytes); }

  /// Whether kernels work in host memory itself, as on a CPU; else on copies.
  bool works_in_host_memory() const { return info_.shares_host_memory && !copies_; }

  /// Work on copies, in bands that fit the memory, as on a device with memory of its own.
  void set_copies(bool copies) { copies_ = copies; }

  /// From here on what kernels are to write is filled with this byte, where OpenCL leaves it
  /// undefined: what a kernel reads before anyone wrote it shows in its result.
  void fill_buffers(unsigned char byte) { fill_ = byte; }

  const Traffic& traffic() const { return *traffic_; }

  cl::Buffer buffer(std::size_t bytes);

  /// A read-only view of host memory; a copy where the device has memory of its own. The memory
  /// must stay alive and unchanged as long as the buffer.
  cl::Buffer view(const void* data, std::size_t bytes);
  template <typename T>
  cl::Buffer view(const std::vector<T>& plane) {
    return view(plane.data(), plane.size() * sizeof(T));
  }

  /// Host memory for kernels to write where the device works there; the memory must stay alive as
  /// long as the buffer.
  cl::Buffer write_view(void* data, std::size_t bytes);

  /// The same for kernels to change.
  cl::Buffer change_view(void* data, std::size_t bytes) { return view(data, bytes); }

  /// Values for kernels to read, on the device from now on; they may not be changed meanwhile.
  template <typename T>
  cl::Buffer in(const Values<T>& values) {
    if (values.empty()) return nothing_;
    if (DeviceBuffer* there = here(values.device())) return there->use();
    void* host = const_cast<T*>(values.host().data());  // OpenCL's signature has no const
    auto made = hold(host, values.size() * sizeof(T));
    const cl::Buffer buffer = made->use();
    values.share(std::move(made));
    return buffer;
  }

  /// Room for `count` values that kernels write.
  template <typename T>
  cl::Buffer out(Values<T>& values, std::size_t count) {
    values = works_in_host_memory() ? Values<T>::room(count) : Values<T>();
    void* host = const_cast<T*>(values.empty() ? nullptr : values.host().data());
    auto made = room(host, count * sizeof(T));
    const cl::Buffer buffer = made->use();
    if (host) {
      values.put(std::move(made));
    } else {
      values = Values<T>::on(std::move(made), count);
    }
    return buffer;
  }

  /// Values for kernels to change.
  template <typename T>
  cl::Buffer in_out(Values<T>& values) {
    if (!values.is_own()) values.edit();
    const cl::Buffer buffer = in(values);
    values.written_by_device();
    return buffer;
  }

  /// What kernels have written to a buffer, while `look` runs: no copy where the device works in
  /// host memory.
  template <typename T, typename Look>
  void look_at(const cl::Buffer& buffer, std::size_t count, const Look& look) {
    const auto* values = static_cast<const T*>(map(buffer, count * sizeof(T)));
    look(std::span<const T>(values, count));
    unmap(buffer, values);
  }

  /// What kernels have written to a buffer goes to `place`, unless the buffer is a view of it.
  template <typename T>
  void bring(const cl::Buffer& buffer, std::size_t count, T* place) {
    look_at<T>(buffer, count, [&](std::span<const T> made) {
      if (made.data() != place) std::copy(made.begin(), made.end(), place);
    });
  }

  /// Every byte of a buffer.
  void clear(const cl::Buffer& buffer, std::size_t bytes);

  void read(const cl::Buffer& buffer, void* data, std::size_t bytes, std::size_t offset = 0);
  void write(const cl::Buffer& buffer, const void* data, std::size_t bytes);

  /// Enqueues kernel `name` over at least `global` work-items (kernels test their bounds).
  template <typename... Args>
  void launch(const char* name, const std::vector<std::size_t>& global, const Args&... args) {
    launch_from({}, name, global, args...);
  }

  /// The same for work-items whose global ids begin at `first`; empty: at 0.
  template <typename... Args>
  void launch_from(const std::vector<std::size_t>& first, const char* name,
                   const std::vector<std::size_t>& global, const Args&... args) {
    cl::Kernel& kernel = kernel_of(name);
    [[maybe_unused]] cl_uint index = 0;
    given_.clear();
    (set_arguments(kernel, name, index, args), ...);
    enqueue(kernel, name, global, first);
  }

  void finish();

 private:
  cl::Kernel& kernel_of(const char* name);
  template <typename T>
  void set_arguments(cl::Kernel& kernel, const char* name, cl_uint& index, const T& value) {
    try {
      kernel.setArg(index, value);
    } catch (const cl::Error& error) {
      fail_argument(name, index, error.err());
    }
    ++index;
  }
  void set_arguments(cl::Kernel& kernel, const char* name, cl_uint& index,
                     const cl::Buffer& buffer) {
    if (measures_) given_.insert(buffer());
    set_arguments<cl::Buffer>(kernel, name, index, buffer);
  }
  /// Channels are one argument after the other.
  void set_arguments(cl::Kernel& kernel, const char* name, cl_uint& index,
                     const std::array<cl::Buffer, 4>& channels) {
    for (const cl::Buffer& channel : channels) set_arguments(kernel, name, index, channel);
  }
  void note_bytes(const char* name);
  const void* map(const cl::Buffer& buffer, std::size_t bytes);
  void unmap(const cl::Buffer& buffer, const void* mapped);
  [[noreturn]] void fail_argument(const char* name, cl_uint index, int code) const;
  void enqueue(cl::Kernel& kernel, const char* name, const std::vector<std::size_t>& global,
               const std::vector<std::size_t>& first);

  /// The device's side of values if it is on this device.
  DeviceBuffer* here(DeviceValues* values) const;
  /// Values of host memory; room for values, in host memory where this device works there.
  std::unique_ptr<DeviceBuffer> hold(void* host, std::size_t bytes);
  std::unique_ptr<DeviceBuffer> room(void* host, std::size_t bytes);
  std::unique_ptr<DeviceBuffer> device_buffer(const cl::Buffer& buffer, std::size_t bytes);

  DeviceInfo info_;
  bool int64_atomics_, vectors_, measures_, copies_ = false;
  std::size_t memory_bytes_ = default_memory_bytes;
  std::optional<unsigned char> fill_;
  std::map<std::string, std::vector<cl::Event>> events_;
  std::map<std::string, std::size_t> kernel_bytes_;
  std::set<cl_mem> given_;  ///< To the launch that is being made.
  std::map<std::string, std::array<std::size_t, 2>> groups_, tuned_;  ///< Not the launch table's.
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  cl::Buffer nothing_;                                  ///< For planes that are empty.
  std::map<std::string, cl::Kernel> kernels_;           ///< Kept: Mesa compiles each new one anew.
  std::map<std::string, std::size_t> most_work_items_;  ///< In a group of each of these.
  std::shared_ptr<Traffic> traffic_ = std::make_shared<Traffic>();
};

}  // namespace defray
