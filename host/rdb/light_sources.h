#pragma once
// Small bright sources that do not go with the rays: discs of the aperture's shape.
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/params.h"

namespace defray {

/// Sources of light for kernel `highlights_add`, each a box of pixels, in the order of their first.
struct LightSources {
  /// x, y of the first pixel, CoC in quanta, columns + DEFRAY_LIGHT_ROW * rows.
  std::vector<std::array<std::int32_t, 4>> where;
  /// Light of each pixel; a missing channel repeats the last.
  std::vector<std::array<float, 4>> excess;
  int tiles_x = 0;
  /// Sources whose disc meets a tile of DEFRAY_LIGHT_TILE pixels a side: list[first[tile]] and on.
  std::vector<std::uint32_t> first, list;
  std::vector<std::uint32_t> table;  ///< The aperture's summed light.
  float share_of_light = 0;          ///< 1 / its total.
  /// Maps of which parts of the lens see each: (first entry, side, least CoC of what may hide it,
  /// 0), side 0 where all do, and entries of all.
  std::vector<std::array<std::int32_t, 4>> maps;
  std::size_t map_entries = 0;

  bool empty() const { return where.empty(); }
};

/// Rows from a target to the farthest source whose disc reaches it, less the largest CoC, and to
/// the farthest to which a way leads that its place in a map depends on: entries lie up to 1/32 of
/// a CoC apart, and groups are whole.
inline int light_map_rows(std::int32_t largest_coc_quanta) {
  return 2 + DEFRAY_LIGHT_GROUP + (largest_coc_quanta >> DEFRAY_COC_FRACTION_BITS) / 16;
}

}  // namespace defray
