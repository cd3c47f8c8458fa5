#pragma once
// Where rays land, lens point by lens point: the table of kernel `rdb_gather`.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/params.h"
#include "lens/lens_points.h"

namespace defray {

/// Radii that land at one offset: (dx, dy, least radius, largest - least), px and quanta.
using Segment = std::array<std::int32_t, 4>;

/// CoC radii in bins: bin b has those from (first_bin + b) << shift on, below the next bin; the
/// first and last bins those beyond, too. 0 is where a bin begins.
struct RadiusBins {
  std::int32_t least, largest;  ///< Radii of the frame.
  int first_bin = 0, shift = 0;

  /// For a frame whose larger side is so long: radii whose rays leave it need no bins of their own.
  RadiusBins(std::int32_t least, std::int32_t largest, int longest_side_px);

  /// The smallest radius of a bin.
  std::int64_t first_radius(int bin) const;
  /// The largest |radius| of a bin.
  std::int64_t largest_of(int bin) const;
};

/// A pass of cells: the segments that land within a frame of `width` x `height` from any of its
/// pixels, by cell and ascending radius; and for each cell and bin the first segment that reaches
/// into the bin, at last one past the cell's.
struct SegmentTable {
  std::vector<Segment> segments;
  std::vector<std::int32_t> first;  ///< [cells][bins + 1]

  /// From `first_cell` on as many cells as have `most` segments together, one at least. The ways
  /// from one run of bins to the next count too.
  SegmentTable(const LensPoints& lens, int first_cell, const RadiusBins& bins, int width,
               int height, std::size_t most);

  int cell_count() const { return static_cast<int>(first.size()) / (DEFRAY_RAY_BINS + 1); }
};

}  // namespace defray
