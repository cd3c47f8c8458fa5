#pragma once
// What the simulator Oclgrind reports: races, memory outside buffers.
#include <memory>
#include <string>

#include "opencl/device.h"
#include "temporary_folder.h"

namespace defray::validation {

/// Turns the race detector on and keeps the simulator's log, on Oclgrind; nothing elsewhere. Must
/// be there before the device's context.
class OclgrindLog {
 public:
  explicit OclgrindLog(const DeviceInfo& info);
  ~OclgrindLog();
  OclgrindLog(const OclgrindLog&) = delete;
  OclgrindLog& operator=(const OclgrindLog&) = delete;

  /// What was reported since the last call: its first lines; empty: nothing.
  std::string take();

 private:
  std::unique_ptr<TemporaryFolder> folder_;
  std::string path_;
  std::size_t read_ = 0;
};

/// Whether a device is simulated: a thousand times slower than others.
bool is_simulator(const DeviceInfo& info);

}  // namespace defray::validation
