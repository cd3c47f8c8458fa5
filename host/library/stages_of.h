#pragma once
// What a device of the API is made of.
#include "defray/device.h"
#include "frame/stages.h"

namespace defray {

/// Alive as long as the device.
Stages& stages_of(Device& device);

}  // namespace defray
