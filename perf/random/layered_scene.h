#pragma once
// Flat layers at a few depths: scenes in which nothing but what hides what is hard.
#include <cstdint>

#include "scenes/scene.h"

namespace defray::perf {

/// Two to four layers that face the camera, a wall the farthest, each with one texture, one of
/// which may be noise a pixel or two fine. Its one setting, "layered", focuses on one of them; the
/// largest CoC is 0.5 to 5 % of the picture's width. The same seed gives the same scene at every
/// size.
Scene layered_scene(int width, int height, std::uint32_t seed);

}  // namespace defray::perf
