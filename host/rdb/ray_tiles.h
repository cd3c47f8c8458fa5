#pragma once
// What kernel `rdb_gather` knows of a frame before it starts.
#include <array>
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "rdb/segments.h"

namespace defray {

/// A set of bins of radii.
using BinSet = std::array<std::uint64_t, DEFRAY_RAY_WORDS>;

/// What a tile holds, or what can reach it: bins of plain surfaces (whole, seen, in front), and of
/// all others.
struct TileBins {
  BinSet plain{}, special{};
  bool operator==(const TileBins&) const = default;
};

/// Planes with a run's columns and a tile's rows of nothing around them, [layer][row][stride].
struct PaddedPlanes {
  std::vector<std::int32_t> keys;     ///< Least radii of spans; DEFRAY_NO_KEY: no surface.
  std::vector<std::int32_t> largest;  ///< Their largest; empty: there are no spans.
  /// turn | (coverage - 1) << 16, and coverage; empty where the frame has none.
  std::vector<std::uint32_t> sending, coverage;
  std::vector<std::vector<float>> channels;
};

/// Of a whole frame, tiles row by row.
struct RayTiles {
  PaddedPlanes padded;
  std::vector<TileBins> held, reach;
  std::vector<std::int32_t> least;  ///< |radius|, quanta; 0 where the front has a hole.
  /// A tile's rows, a bit each: those that hold others than plain surfaces.
  std::vector<std::uint32_t> special_rows;
};

/// The bins of a frame's radii.
RadiusBins bins_of(const Frame& frame);

/// Tiles along so many pixels; pixels in a row of a padded plane.
int ray_tiles_along(int pixels);
int padded_stride(int width);

/// Bins that reach from so many tiles away: pixels of other tiles are that far apart at least.
std::vector<BinSet> bins_by_distance(const RadiusBins& bins, int tiles);

/// Bins whose rays end where they begin, whatever the lens point.
BinSet sharp_bins(const RadiusBins& bins, const LensPoints& lens);

}  // namespace defray
