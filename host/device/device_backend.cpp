#include "device/device_backend.h"

#include "base/error.h"

namespace defray {

void DeviceBackend::require_memory(const Frame& f, std::size_t bytes) {
  // Of host memory only a device that shares it tells how much there is.
  const DeviceInfo& device = session_.info();
  if (!device.shares_host_memory || bytes <= device.global_memory_bytes) return;
  fail(
      ErrorKind::device,
      "{}x{} pixels: the stages of rdb need about {} MiB of host memory, {} has {} MiB; {} needs a "
      "third",
      f.width, f.height, bytes >> 20, device.name, device.global_memory_bytes >> 20,
      field("literal"));
}

}  // namespace defray
