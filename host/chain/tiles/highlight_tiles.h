#pragma once
// Where `highlights` may find any.
#include "frame/frame.h"

namespace defray {

/// How far from a fragment with CoC `coc_quanta` `highlights` looks, px, as the kernel has it.
int highlight_reach(std::int32_t coc_quanta);

/// For each tile of DEFRAY_HIGHLIGHT_TILE pixels a side the least light (largest light channel) of
/// the seen front fragments that its fragments can look at, or less; infinite where there are none.
/// [tiles_y][tiles_x], of wanted rows.
Values<float> darkest_around(const Frame& frame, int light_channels);

}  // namespace defray
