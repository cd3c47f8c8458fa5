#pragma once
// Where pictures are rendered.
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "defray/export.h"

namespace defray {

class Backend;
struct Costs;

/// What matters to defray about an OpenCL device.
struct DeviceProperties {
  std::string name;
  std::string platform;
  std::string version;  ///< OpenCL and driver version.
  std::string type;     ///< CPU, GPU, accelerator.
  std::size_t compute_units = 0;
  std::size_t max_work_group = 0;
  std::size_t global_memory_bytes = 0;
  std::size_t local_memory_bytes = 0;
  std::size_t max_buffer_bytes = 0;
  bool has_int64_atomics = false;  ///< Without them the scatter runs twice.
  bool has_double = false;
  bool rounds_divisions = false;    ///< x / y and sqrt(x) can be correctly rounded, if asked for.
  bool keeps_denormals = false;     ///< Otherwise floats below 2^-126 may count as 0.
  bool shares_host_memory = false;  ///< A CPU: buffers can be host memory itself.

  bool is_gpu() const { return type == "GPU"; }
};

/// How kernels compute.
enum class Math {
  strict,  ///< As written, every operation rounded: the same bits on every device.
  fast,    ///< The compiler may fuse and approximate: results differ from device to device.
};

/// What the stages take of a device where nobody says otherwise.
inline constexpr std::size_t default_memory_bytes = std::size_t{512} << 20;

struct DeviceOptions {
  Math math = Math::strict;
  /// Work-groups that `defray tune` found for this device: the same bits, sooner.
  bool use_tuning = true;
  bool measures = false;  ///< Keeps each kernel's time, for take_kernel_seconds().
};

/// A device made ready: its kernels are built once, here. For one thread at a time; several devices
/// are independent of each other.
class DEFRAY_API Device {
 public:
  /// Every OpenCL device, in platform order; empty where there is none.
  static std::vector<DeviceProperties> list();

  /// The OpenCL device with this index in list(), or the one whose "platform device" names contain
  /// `name` (any case); an empty name is the first device, PoCL's before others; "reference" is
  /// reference(). Throws Error(device) when there is none, none matches, several do, or its kernels
  /// cannot be built.
  static Device open(const std::string& name = "", const DeviceOptions& options = {});

  /// The scalar twins of the kernels: one thread, no OpenCL, slow, the same bits.
  static Device reference();

  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;
  ~Device();

  const std::string& name() const;

  /// What the user should know: why work-groups found by `defray tune` are not used.
  const std::vector<std::string>& notes() const;

  /// Throws Error(usage) for the reference.
  const DeviceProperties& properties() const;

  /// Seconds that each kernel has run on the device since the last call, by its name; nothing
  /// without DeviceOptions::measures. Throws Error(usage) for the reference.
  std::map<std::string, double> take_kernel_seconds();

  /// What is made on the device at a time for one stage; default_memory_bytes unless set. The same
  /// bits come from more or less. Throws Error(usage) for the reference, which has no device
  /// memory.
  void set_memory(std::size_t bytes);

  /// Work-group of every kernel, or of one; {0, 0}: as tuned, or each kernel's own, the default.
  /// The same bits come from any. Throws Error(usage) for more work-items than the device allows, a
  /// kernel that there is not, and the reference.
  void set_work_group(std::size_t x, std::size_t y);
  void set_work_group(const std::string& kernel, std::size_t x, std::size_t y);

 private:
  struct State;
  explicit Device(std::unique_ptr<State> state);
  State& state_on_device(const char* setting) const;
  friend Backend& backend_of(Device& device);
  friend Costs& costs_of(Device& device);
  friend std::vector<std::string> use_tuning(Device& device, const std::string& frame_class);

  std::unique_ptr<State> state_;
};

}  // namespace defray
