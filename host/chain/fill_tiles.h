#pragma once
// Where `fill` has anything to do, and how far it looks.
#include <cstdint>

#include "frame/frame.h"

namespace defray {

/// How far `fill` looks from a pixel with CoC `own`, px, as the kernel has it.
int fill_reach(std::int32_t farthest, std::int32_t own);

/// Tiles of DEFRAY_FILL_TILE pixels a side with a mixed pixel close enough to matter: elsewhere
/// nothing lies behind. [tiles_y][tiles_x].
Words tiles_to_fill(const Frame& frame, const Words& mixed);

}  // namespace defray
