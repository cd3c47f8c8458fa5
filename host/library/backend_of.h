#pragma once
// What a device of the API is made of.
#include "defray/device.h"
#include "frame/backend.h"

namespace defray {

/// Alive as long as the device.
Backend& backend_of(Device& device);

}  // namespace defray
