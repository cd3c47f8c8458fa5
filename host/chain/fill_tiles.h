#pragma once
// Where `fill` has anything to do, and how far it looks.
#include <cstdint>

#include "frame/frame.h"

namespace defray {

/// How far `fill` looks from a pixel with CoC `own`, px, as the kernel has it.
int fill_reach(std::int32_t farthest, std::int32_t own);

/// For each tile of DEFRAY_FILL_TILE pixels a side the farthest CoC that a ray over the picture
/// from one of its pixels can meet; DEFRAY_NOTHING_BEHIND where no mixed pixel is close enough to
/// matter: nothing lies behind there. [tiles_y][tiles_x].
Quanta farthest_to_fill(const Frame& frame, const Words& mixed);

}  // namespace defray
