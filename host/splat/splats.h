#pragma once
// Splats on their way to pixels.
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "frame/values.h"
#include "kernels/splat_params.h"

namespace defray {

/// What `splat_project` gives.
struct Splats {
  Values<DefraySplat> all;
  Values<DefraySplatLine> lines;  ///< Sets of DEFRAY_SPLAT_RIDGES at which some end.
};

/// What `splat_resolve` gives, planes of the picture.
struct SplatPlanes {
  std::vector<Plane> colour;  ///< R G B A.
  Plane depth, fragments;
};

/// Those that have pixels, in the order in which `splat_resolve` takes them: by z, equal ones as
/// they were.
Splats in_order(const Splats& splats);

/// Tiles one after the other, row by row: how many splats meet each.
std::vector<std::uint32_t> splats_a_tile(const Values<DefraySplat>& splats, int tiles_x,
                                         int tiles_y);

/// A group of tiles and the splats that meet each.
struct SplatTiles {
  std::uint32_t first_tile = 0, tile_count = 0;
  std::vector<std::uint32_t> first;  ///< [tile_count + 1]: where a tile's part of the list begins.
  std::vector<std::uint32_t> list;   ///< Indices of splats, ascending in each tile.
};

/// The next tiles from `first_tile` on whose list has no more than `most` entries, but one tile at
/// least.
SplatTiles next_tiles(const Values<DefraySplat>& splats, const std::vector<std::uint32_t>& counts,
                      int tiles_x, std::uint32_t first_tile, std::size_t most);

}  // namespace defray
