#pragma once
// What a device of the API is made of.
#include <string>
#include <vector>

#include "defray/device.h"
#include "frame/backend.h"

namespace defray {

/// Alive as long as the device.
Backend& backend_of(Device& device);

/// From here on work-groups are those tuned for such frames; names those that are used so, as
/// "fill=16x1".
std::vector<std::string> use_tuning(Device& device, const std::string& frame_class);

}  // namespace defray
