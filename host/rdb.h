#pragma once
// The ray distribution buffer on OpenCL: CoC, scatter, merge, in memory-bounded passes.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lens.h"
#include "lens_cells.h"
#include "opencl/session.h"

namespace defray {

/// A plane of floats, row-major, width x height.
using Plane = std::vector<float>;

struct RdbSettings {
  int cells_per_side = 9;
  bool jitter = false;
  std::uint32_t seed = 0;
  std::size_t memory_bytes = std::size_t{512} << 20;  ///< For cells and sums of one pass.
};

/// One pass: which target rows, which lens cells, and which source rows can reach them.
struct RdbPass {
  int band_y, band_rows;
  int window_y, window_rows;
  int first_cell, cell_count;
};

/// Rows beyond a target row from which a ray can come, for this largest |CoC| in quanta.
int rdb_reach(std::int32_t largest_coc_quanta);

/// Cuts a frame into passes whose cells and sums fit `memory_bytes`: bands from the top, and in
/// each band all cells in order. Throws Error(usage) when one row of one cell does not fit.
std::vector<RdbPass> plan_rdb_passes(int width, int height, int cell_count, int reach,
                                     std::size_t memory_bytes);

/// Signed CoC radius of every pixel, in quanta (1/256 px). `depth` is planar, > 0, +inf: background.
std::vector<std::int32_t> coc_on_device(Session& session, const Lens& lens, int display_width_px,
                                        const Plane& depth);

/// A winner of one cell: all ones where no ray arrived.
struct RdbWinner {
  std::uint32_t source;      ///< Index in the pass's source window, row-major.
  std::uint32_t depth_bits;  ///< Bits of its depth.
};

/// Scatters one pass and returns its winners, [cell][band row][x]. For checks against the twin.
std::vector<RdbWinner> rdb_winners_on_device(Session& session, int width, const RdbPass& pass,
                                             const LensCells& cells, std::uint32_t seed,
                                             const std::vector<std::int32_t>& coc_quanta,
                                             const Plane& depth);

/// The lens picture: 1 to 4 channels in, as many out. `progress` gets the share done, 0 to 1.
std::vector<Plane> render_rdb(Session& session, int width, int height,
                              const std::vector<std::int32_t>& coc_quanta, const Plane& depth,
                              const std::vector<Plane>& channels, const RdbSettings& settings,
                              const std::function<void(double)>& progress = {});

}  // namespace defray
