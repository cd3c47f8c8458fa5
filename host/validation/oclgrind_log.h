#pragma once
// What the simulator Oclgrind reports: races, memory outside buffers.
#include <cstdint>
#include <string>

namespace defray {
struct DeviceInfo;
}

namespace defray::validation {

/// Turns the race detector on and keeps the simulator's log, on Oclgrind; nothing elsewhere. Must
/// be there before the device's context.
class OclgrindLog {
 public:
  explicit OclgrindLog(const DeviceInfo& info);

  /// What was reported since the last call: its first lines; empty: nothing.
  std::string take();

 private:
  int file_ = -1;
  std::int64_t read_ = 0;
};

/// Whether a device is simulated: a thousand times slower than others.
bool is_simulator(const DeviceInfo& info);

}  // namespace defray::validation
