#pragma once
// The ray distribution buffer (Shinya 1994): what its rays go through, and what they give.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.h"
#include "defray/options.h"
#include "lens/lens_points.h"

namespace defray {

/// What rays of a frame go through.
struct RayPlan {
  LensPoints lens;
  std::uint32_t seed = 0;          ///< Of the jitter.
  int origin_x = 0, origin_y = 0;  ///< Of the frame in the display window: jitter follows it.
  /// Cat's eye: the rim's centre for each column and row, 2^-16 of the aperture radius, as
  /// lens/cats_eye.h has it. Empty: none.
  std::vector<std::int32_t> rim_x = {}, rim_y = {};
  bool has_spans = false;      ///< Fragments are pieces of a surface (kernels/rdb/span.clh).
  bool wants_nearest = false;  ///< RayResult::nearest is filled.
  /// From these CoC radii on, quanta, half and a quarter of a tile's rows have rays
  /// (rdb/sparse_tiles.h). 0: all have.
  std::array<std::int32_t, 2> sparse_from = {};
  RaysBy by = RdbSettings().rays;  ///< The same bits.
};

/// Throws Error(usage) as make_lens_grid does.
RayPlan plan_rays(const RdbSettings& settings);

/// What the ray distribution buffers give.
struct RayResult {
  std::vector<Plane> means;         ///< As many as there are channels.
  std::vector<std::uint32_t> seen;  ///< Cells of each pixel won by a surface that was seen.
  /// The pixel whose data each pixel gets: of the nearest surface with data among all its cells'
  /// winners (equal depths: the first in the frame). DEFRAY_EMPTY where there is none.
  std::vector<std::uint32_t> nearest = {};
  std::size_t interpolated = 0;  ///< Pixels of the picture between rows that have rays.
};

/// Nearest hits with each pixel itself where there is none.
std::vector<std::uint32_t> or_own_pixel(std::vector<std::uint32_t> nearest);

/// Lens points that the rim leaves open for a pixel; all of them without one.
std::size_t open_cells(const RayPlan& plan, std::size_t x, std::size_t y);

}  // namespace defray
