#include "open_device.h"

#include "standard_streams.h"

namespace defray::cli {

Device open_device(const std::string& name, const DeviceOptions& options, bool is_quiet) {
  Device device = Device::open(name, options);
  if (is_quiet) return device;
  for (const std::string& note : device.notes()) print_error("defray: note: " + note);
  return device;
}

}  // namespace defray::cli
