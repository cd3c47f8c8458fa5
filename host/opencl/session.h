#pragma once
// One device, made ready: context, queue and the kernels, built once.
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "opencl/device.h"

namespace defray {

/// What passes take of a device where nobody says otherwise.
inline constexpr std::size_t default_memory_bytes = std::size_t{512} << 20;

/// How kernels compute.
enum class Math {
  strict,  ///< As written, every operation rounded: the scalar twins' bits.
  fast,    ///< The compiler may fuse and approximate: results differ from device to device.
};

/// A change of the kernels' text, for experiments and for faults that tests must find.
struct Substitution {
  std::string from, to;
  bool everywhere = false;  ///< Otherwise `from` must be there exactly once.
};

struct SessionOptions {
  bool use_int64_atomics = true;  ///< False: the two-pass scatter even where the device has them.
  Math math = Math::strict;
  std::string build_options = {};  ///< More options for the OpenCL compiler.
  std::vector<Substitution> substitutions = {};
  bool half_planes = false;  ///< `picture` hands kernels half floats: they must be told to read so.
  bool measures = false;     ///< Keep each kernel's time on the device.
};

/// Runs kernels on one device. Every failure is an Error(device) that names the call and the
/// OpenCL error; a failed build carries the compiler's log.
class Session {
 public:
  explicit Session(const DeviceInfo& info, const SessionOptions& options = {});

  const DeviceInfo& info() const { return info_; }
  bool has_int64_atomics() const { return int64_atomics_; }

  /// Names of all kernels of the program, sorted.
  std::vector<std::string> kernel_names() const;

  /// Seconds that each kernel has run since the last call. Needs SessionOptions::measures.
  std::map<std::string, double> take_kernel_seconds();

  /// Work-group for every kernel, {x, y}; {0, 0}: each kernel's own default.
  void set_work_group(std::size_t x, std::size_t y);
  /// For one kernel, whatever is set for all.
  void set_work_group(const std::string& kernel, std::size_t x, std::size_t y);

  cl::Buffer buffer(std::size_t bytes);

  /// From here on new buffers are filled with this byte, where OpenCL leaves them undefined: what a
  /// kernel reads before anyone wrote it shows in its result.
  void fill_buffers(unsigned char byte) { fill_ = byte; }

  /// A read-only view of host memory; no copy where the device shares it. The memory must stay
  /// alive and unchanged as long as the buffer.
  cl::Buffer view(const void* data, std::size_t bytes);
  template <typename T>
  cl::Buffer view(const std::vector<T>& plane) {
    return view(plane.data(), plane.size() * sizeof(T));
  }

  /// A read-only view of colour or depth: `view`, or a copy in half floats where so asked.
  cl::Buffer picture(const float* data, std::size_t count);

  void read(const cl::Buffer& buffer, void* data, std::size_t bytes, std::size_t offset = 0);
  void write(const cl::Buffer& buffer, const void* data, std::size_t bytes);

  /// Enqueues kernel `name` over at least `global` work-items (kernels test their bounds).
  template <typename... Args>
  void launch(const char* name, std::size_t default_group_x, const std::vector<std::size_t>& global,
              const Args&... args) {
    launch_from({}, name, default_group_x, global, args...);
  }

  /// The same for work-items whose global ids begin at `first`; empty: at 0.
  template <typename... Args>
  void launch_from(const std::vector<std::size_t>& first, const char* name,
                   std::size_t default_group_x, const std::vector<std::size_t>& global,
                   const Args&... args) {
    cl::Kernel& kernel = kernel_of(name);
    cl_uint index = 0;
    (set_argument(kernel, name, index++, args), ...);
    enqueue(kernel, name, default_group_x, global, first);
  }

  void finish();

 private:
  void check_work_group(std::size_t x, std::size_t y) const;
  cl::Kernel& kernel_of(const char* name);
  template <typename T>
  void set_argument(cl::Kernel& kernel, const char* name, cl_uint index, const T& value) {
    try {
      kernel.setArg(index, value);
    } catch (const cl::Error& error) {
      fail_argument(name, index, error.err());
    }
  }
  [[noreturn]] void fail_argument(const char* name, cl_uint index, int code) const;
  void enqueue(cl::Kernel& kernel, const char* name, std::size_t default_group_x,
               const std::vector<std::size_t>& global, const std::vector<std::size_t>& first);

  DeviceInfo info_;
  bool int64_atomics_, half_planes_, measures_;
  std::optional<unsigned char> fill_;
  std::map<std::string, std::vector<cl::Event>> events_;
  using WorkGroup = std::array<std::size_t, 2>;
  WorkGroup group_ = {};
  std::map<std::string, WorkGroup> group_of_;  ///< Of single kernels.
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  std::map<std::string, cl::Kernel> kernels_;  ///< Kept: Mesa compiles each new one anew.
};

/// "CL_INVALID_VALUE" for -30, and so on; "OpenCL error N" for codes outside OpenCL 1.2.
std::string opencl_error_name(int code);

}  // namespace defray
