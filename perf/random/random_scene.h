#pragma once
// Scenes that nobody made: what predicted errors are set by, and tested on.
#include <cstdint>

#include "scenes/scene.h"

namespace defray::perf {

/// Things of random shape, texture and depth before a wall or over a floor: bars, discs, stars,
/// balls, thin blades, lamps. Its one setting, "random", focuses on one of them; the largest CoC
/// is some 0.5 to 5 % of the picture's width. The same seed gives the same scene at every size.
Scene random_scene(int width, int height, std::uint32_t seed);

}  // namespace defray::perf
