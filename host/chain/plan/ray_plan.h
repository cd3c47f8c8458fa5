#pragma once
// Which rays the chain sends.
#include "defray/options.h"
#include "frame/frame.h"
#include "rdb/rdb.h"

namespace defray {

/// Rays through the aperture's sample points. Throws Error(usage) for settings out of range.
RayPlan ray_plan(const ChainSettings& settings, bool wants_nearest);

/// Sets where the frame lies: for what is random, and for the lens's rim with a cat's eye.
void place_rays(const Frame& frame, double cats_eye, RayPlan& plan);

}  // namespace defray
