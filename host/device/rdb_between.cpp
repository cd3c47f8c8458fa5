// Kernel `rdb_between`.
#include "device/rdb_tiles.h"
#include "opencl/launch_table.h"

namespace defray {
namespace {

const LaunchRow rdb_between_launch({.kernel = "rdb_between", .group = {64, 1}});

}  // namespace

void RayTileWindow::interpolate(Rows rows, RayResult& out) {
  const Rows wanted = frame_.wanted_rows();
  const std::size_t pixels = interpolated_pixels(sparse_tiles_, tiles(), frame_, rows);
  if (pixels == 0) return;
  out.interpolated += pixels;
  DefrayRaysParams p = params;
  p.band_x = word(frame_.margin);
  p.band_end = word(frame_.width - frame_.margin);
  p.band_y = word(rows.y);
  p.band_rows = word(rows.count());
  const std::size_t first = size(rows.y - wanted.y) * p.width, count = size(rows.count()) * p.width;
  std::vector<cl::Buffer> means;
  for (Plane& mean : out.means) means.push_back(lent(session_, &mean[first], count));
  const cl::Buffer seen = lent(session_, &out.seen[first], count);
  const auto four = four_channels(means.size(), [&](std::size_t c) { return means[c]; });
  session_.launch("rdb_between", {p.band_end - p.band_x, size(rows.count())}, p, sparsity, four,
                  seen);
  for (std::size_t c = 0; c < means.size(); ++c) {
    session_.bring(means[c], count, &out.means[c][first]);
  }
  session_.bring(seen, count, &out.seen[first]);
}

}  // namespace defray
