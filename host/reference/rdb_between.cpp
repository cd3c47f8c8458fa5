// Twin of kernels/rdb/rdb_between.cl: the rows that have rays are listed, those between weighted.
#include <algorithm>

#include "rdb/sparse_tiles.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

using RowList = std::vector<int>;

/// A tile's rows that have rays.
const RowList& rows_with_rays(std::uint32_t sparsity) {
  static const RowList half{0, 2, 5, 7, 8, 10, 13, 15}, quarter{0, 5, 10, 15};
  return sparsity == 1 ? half : quarter;
}

float between(float above, float below, float share) {
  return above == below ? above : above * (1 - share) + below * share;
}

struct Between {
  int at, above, below;
};

void interpolate(const Frame& f, const Between& row, int x, RayResult& out) {
  const auto pixel = [&](int y) { return size(y) * size(f.width) + size(x); };
  const std::size_t at = pixel(row.at), above = pixel(row.above), below = pixel(row.below);
  const int rows = row.below - row.above, down = row.at - row.above;
  const float share = static_cast<float>(down) * (1 / static_cast<float>(rows));
  for (Plane& mean : out.means) mean[at] = between(mean[above], mean[below], share);
  const auto weight = static_cast<std::uint32_t>(down), all = static_cast<std::uint32_t>(rows);
  out.seen[at] = (out.seen[above] * (all - weight) + out.seen[below] * weight + all / 2) / all;
  ++out.interpolated;
}

}  // namespace

void rdb_between(const Frame& f, const std::vector<std::uint32_t>& sparsity, RayResult& out) {
  const int across = ray_tiles_along(f.width);
  for (int y = f.margin; y < f.height - f.margin; ++y) {
    for (int x = f.margin; x < f.width - f.margin; ++x) {
      const int top = y / DEFRAY_RAY_TILE * DEFRAY_RAY_TILE;
      const int tile = top / DEFRAY_RAY_TILE * across + x / DEFRAY_RAY_TILE;
      if (sparsity[size(tile)] == 0) continue;
      const RowList& rows = rows_with_rays(sparsity[size(tile)]);
      const auto next = std::ranges::lower_bound(rows, y - top);
      if (*next != y - top) interpolate(f, {y, top + *(next - 1), top + *next}, x, out);
    }
  }
}

}  // namespace defray::reference
