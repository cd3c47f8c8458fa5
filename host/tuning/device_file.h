#pragma once
// Files in the user's cache folder that hold what was measured of a device.
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "defray/device.h"

namespace defray::tuning {

using Json = nlohmann::ordered_json;

/// What is measured holds for.
struct Key {
  std::string device, platform, driver;
  std::string kernels;  ///< Hash of their text.
};

Key key_of(const DeviceProperties& device);

Json to_json(const Key& key);

/// "KIND-DEVICE.json" in $XDG_CACHE_HOME/defray or ~/.cache/defray; empty where there is neither.
std::string device_path(const std::string& kind, const Key& key);

/// Gives `take` what the file holds. Why it was not used, and what to do (`otherwise`): it is
/// damaged (or `take` throws), or of another driver or kernels; empty if it was, or is not there.
std::string read_device_file(const std::string& path, const Key& key, const std::string& otherwise,
                             const std::function<void(const Json&)>& take);

/// While it lives no other process of ours changes the file. Makes its folder. Throws
/// Error(output).
class DeviceFileLock {
 public:
  explicit DeviceFileLock(const std::string& path);
  ~DeviceFileLock();
  DeviceFileLock(const DeviceFileLock&) = delete;
  DeviceFileLock& operator=(const DeviceFileLock&) = delete;

 private:
  int file_;
};

}  // namespace defray::tuning
