#pragma once
// Tiles whose rays are found for some of their rows alone.
#include <array>
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "kernels/params.h"
#include "rdb/rdb.h"

namespace defray {

/// RayPlan::sparse_from of the chain. Chosen at 640x400 among 6 and 14, 8 and 20, 10 and 24, 12 and
/// 30, 16 and 36 px: of the 17 settings of nine built-in scenes plate2 f3 loses most, 0.027 dB
/// (0.035 with 8 and 20, 0.010 with 12 and 30); with 6 and 14 plate2 f5 loses 0.20, with 16 and 36
/// none.
inline constexpr std::array<std::int32_t, 2> sparse_from_quanta{10 << DEFRAY_COC_FRACTION_BITS,
                                                                24 << DEFRAY_COC_FRACTION_BITS};

/// Tiles around a tile, on each side, that say how sparse it may be: no radius below a plan's comes
/// from beyond them.
inline constexpr int sparse_reach_tiles = 2;
inline constexpr int sparse_reach_px = sparse_reach_tiles * DEFRAY_RAY_TILE;
static_assert(sparse_from_quanta.back() < sparse_reach_px << DEFRAY_COC_FRACTION_BITS);
// Rows of a frame that come before and behind those that rays are asked for are there by steps.
static_assert(sparse_reach_px <= band_step);

/// The tiles of a window of a frame.
struct TileWindow {
  int y = 0, across = 0, down = 0;
};

/// For each tile 0: all its rows have rays, 1: half, 2: a quarter; kernel `rdb_between`
/// interpolates the others. Rows are left out where no fragment with a CoC radius below the plan's
/// can reach, the tile's front has no hole, all its rows are the picture's, and nobody needs
/// winners. `least` is RayTiles::least.
std::vector<std::uint32_t> sparse_tiles(const std::vector<std::int32_t>& least,
                                        const TileWindow& window, const Frame& frame,
                                        const RayPlan& plan);

/// Pixels of the wanted rows, but for the margin, between rows that have rays.
std::size_t interpolated_pixels(const std::vector<std::uint32_t>& sparsity,
                                const TileWindow& window, const Frame& frame, Rows wanted);

}  // namespace defray
