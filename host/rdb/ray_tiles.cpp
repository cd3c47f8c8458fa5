#include "rdb/ray_tiles.h"

#include <algorithm>

#include "lens/landing_radii.h"

namespace defray {
namespace {

template <typename Holds>
BinSet bins_that(const Holds& holds) {
  BinSet set{};
  for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
    if (holds(b)) set[size(b / 64)] |= std::uint64_t{1} << (b % 64);
  }
  return set;
}

}  // namespace

RadiusBins bins_of(const Frame& frame) {
  const CocRange range = frame.coc_range();
  return {range.least, range.largest, std::max(frame.width, frame.height)};
}

int ray_tiles_along(int pixels) { return (pixels + DEFRAY_RAY_TILE - 1) / DEFRAY_RAY_TILE; }

int padded_stride(int width) {
  return ray_tiles_along(width) * DEFRAY_RAY_TILE + 2 * DEFRAY_RAY_RUN;
}

std::vector<BinSet> bins_by_distance(const RadiusBins& bins, int tiles) {
  std::vector<BinSet> near;
  for (int away = 0; away <= tiles; ++away) {
    const std::int64_t gap_px = std::max(away - 1, 0) * std::int64_t{DEFRAY_RAY_TILE};
    near.push_back(bins_that(
        [&](int b) { return (bins.largest_of(b) >> DEFRAY_COC_FRACTION_BITS) + 1 >= gap_px; }));
  }
  return near;
}

BinSet sharp_bins(const RadiusBins& bins, const LensPoints& lens) {
  return bins_that(
      [&](int b) { return landing_radius(lens, bins.largest_of(b)) < DEFRAY_SHARP_QUANTA; });
}

}  // namespace defray
