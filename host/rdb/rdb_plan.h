#pragma once
// How the ray distribution buffers of a frame are cut to fit a memory budget.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/band_rows.h"
#include "rdb/rdb.h"

namespace defray {

/// A winner of one cell: all ones where no ray arrived.
struct RdbWinner {
  std::uint32_t source;  ///< Index in the pass's source window, row-major.
  std::uint32_t key;  ///< The signed radius as which it won + 2^31: the nearest has the smallest.
};

/// Memory of so many cells of a pixel with the pixel's sums, its nearest hit among them: of one
/// cell, the least that a pass can work with.
std::size_t rdb_bytes_a_pixel(std::size_t cells);

/// One pass: which target rows, which source rows can reach them, and which lens points.
struct RdbPass : BandRows {
  int first_cell, cell_count;
};

/// Rows beyond a target row from which a ray can come, for this largest |CoC| in quanta.
int rdb_reach(std::int32_t largest_coc_quanta);

/// Rows beyond those: what is there says what their pixels span.
int span_rows(const RayPlan& plan);

/// Cuts a frame's `wanted` rows into passes whose cells and sums fit `memory_bytes`: bands from the
/// top, and in each band all cells in order. Throws Error(usage) when
/// one row of the fewest cells does not fit.
std::vector<RdbPass> plan_rdb_passes(int width, Rows wanted, int height, int cell_count, int reach,
                                     std::size_t memory_bytes);

}  // namespace defray
