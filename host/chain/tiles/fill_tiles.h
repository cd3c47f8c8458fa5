#pragma once
// Where `fill` has anything to do, and how far it looks.
#include <cstdint>

#include "frame/frame.h"

namespace defray {

/// How far `fill` looks from a pixel with CoC `own`, px, as the kernel has it.
int fill_reach(std::int32_t farthest, std::int32_t own);

/// Rows above and below a pixel that `fill` looks at, of a frame with these radii.
int fill_rows(const CocRange& range);

/// For each tile of DEFRAY_FILL_TILE pixels a side the farthest CoC that a ray over the picture
/// from one of its pixels can meet; DEFRAY_NOTHING_BEHIND where no mixed pixel is close enough to
/// matter: nothing lies behind there. [tiles_y][tiles_x]; of tiles that lie in no wanted row, too.
Quanta farthest_to_fill(const Frame& frame, const Words& marks);

/// For each cell of DEFRAY_FILL_CELL pixels a side: as many pixels around those of a run of a row
/// that begins in it, in both axes, none is marked: no step of the CoC there is a jump, and no
/// silhouette goes on. Up to 255 px. [cells_y][cells_x].
Values<std::uint8_t> pure_around_runs(const Frame& frame, const Words& marks);

}  // namespace defray
