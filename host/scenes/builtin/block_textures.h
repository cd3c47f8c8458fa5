#pragma once
// What the faces of blocks look like.
#include "base/vec3.h"
#include "scenes/builtin/block_world.h"

namespace defray {

/// Colour of a block's face at (u, v) in [0, 1)^2, v downwards on the sides: 16 x 16 texels.
/// `variant` is a number in [0, 1) of the block's own.
Vec3 block_colour(Block block, bool is_side, double u, double v, double variant);

}  // namespace defray
