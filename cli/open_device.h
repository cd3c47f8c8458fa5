#pragma once
#include <string>

#include "defray/device.h"

namespace defray::cli {

/// Device::open; what the user should know of the device goes to standard error, unless quiet.
Device open_device(const std::string& name, const DeviceOptions& options, bool is_quiet);

}  // namespace defray::cli
