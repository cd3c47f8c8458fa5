#pragma once
#include "device/device_backend.h"

namespace defray::validation {

/// Kernels that no stage shows by itself: the device's own, or else the twin's.
template <typename OnDevice, typename ByTwin>
auto either(Backend& backend, const OnDevice& on_device, const ByTwin& by_twin) {
  auto* const device = dynamic_cast<DeviceBackend*>(&backend);
  return device ? on_device(*device) : by_twin();
}

}  // namespace defray::validation
