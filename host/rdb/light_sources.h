#pragma once
// Small bright sources that do not go with the rays: discs of the aperture's shape.
#include <array>
#include <cstdint>
#include <vector>

namespace defray {

/// Sources of light for kernel `highlights_add`, each a box of pixels, in the order of their first.
struct LightSources {
  /// x, y of the first pixel, CoC in quanta, columns + DEFRAY_LIGHT_ROW * rows.
  std::vector<std::array<std::int32_t, 4>> where;
  std::vector<std::array<float, 4>> excess;  ///< Light of each pixel; missing channels are 0.
  int tiles_x = 0;
  /// Sources whose disc meets a tile of DEFRAY_LIGHT_TILE pixels a side: list[first[tile]] and on.
  std::vector<std::uint32_t> first, list;
  std::vector<std::uint32_t> table;     ///< The aperture's summed light.
  float share_of_light = 0;             ///< 1 / its total.
  std::vector<std::uint32_t> cell_map;  ///< [DEFRAY_CELL_MAP]^2: nearest lens point.
  /// Lens units: cells around the nearest by which light arrives at a pixel, to each side.
  std::int32_t spread = 0;

  bool empty() const { return where.empty(); }
};

}  // namespace defray
