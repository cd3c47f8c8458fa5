#pragma once
// Small bright sources, taken out of the rays and added as discs of the aperture's shape.
#include <array>
#include <cstdint>
#include <vector>

#include "lens/aperture_table.h"
#include "lens/lens_cells.h"
#include "opencl/session.h"
#include "rdb/fragments.h"

namespace defray {

/// Sources of light for kernel `highlights_add`, in source order.
struct LightSources {
  std::vector<std::array<std::int32_t, 4>> where;  ///< x, y, CoC in quanta, depth bits.
  std::vector<std::array<float, 4>> excess;        ///< Light of each; missing channels are 0.
  int tiles_x = 0;
  /// Sources whose disc meets a tile of DEFRAY_LIGHT_TILE pixels a side: list[first[tile]] and on.
  std::vector<std::uint32_t> first, list;
  std::vector<std::uint32_t> table;     ///< The aperture's summed light.
  float share_of_light = 0;             ///< 1 / its total.
  std::vector<std::uint32_t> cell_map;  ///< [DEFRAY_CELL_MAP]^2: lens cell nearest to a lens point.

  bool empty() const { return where.empty(); }
};

/// Kernel `highlights`: the share of its colour that each fragment keeps, 1 but for highlights. The
/// first `light_channels` channels are light; another is alpha.
Plane highlights(Session& session, const Fragments& fragments, int light_channels,
                 std::size_t memory_bytes = default_memory_bytes);

/// Takes from the fragments what `kept` does not leave them, and of their alpha what they
/// have more of than their surroundings.
LightSources take_light(Fragments& fragments, const Plane& kept, int light_channels,
                        const ApertureTable& aperture, const LensCells& cells);

/// For each of DEFRAY_CELL_MAP^2 squares over the lens's square the cell nearest to its centre.
std::vector<std::uint32_t> map_cells(const LensCells& cells);

}  // namespace defray
