#pragma once
// Lens points as Shinya (1994) has them: the centres of n x n cells.
#include "lens/lens_points.h"

namespace defray {

/// The cells over the square around a round aperture that a ray can pass through, row by row: their
/// centres. Throws Error(usage) unless 1 <= cells_per_side <= 64. Without jitter a cell is kept if
/// its centre lies in the unit disc; with jitter, if any of its area does.
LensPoints make_lens_grid(int cells_per_side, bool jitter);

/// How many they are without jitter.
int round_cells(int cells_per_side);

/// Of a square grid as dense as `lens_points` in a disc: sqrt(4 n / pi).
float cells_per_side(int lens_points);

}  // namespace defray
