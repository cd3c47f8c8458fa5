#include "device/rdb_tiles.h"

#include <algorithm>
#include <cstdlib>

#include "device/device_backend.h"
#include "opencl/launch_table.h"
#include "rdb/rdb_plan.h"

namespace defray {
namespace {

// It writes keys, largest radii, what sends rays, coverage, and colours.
const LaunchRow rdb_pad_launch({.kernel = "rdb_pad",
                                .group = {8, 1},
                                .bytes_a_surface = 4 * Launch::plane + Launch::colour});
const LaunchRow rdb_reach_launch({.kernel = "rdb_reach", .group = {16, 1}});
const LaunchRow rdb_tiles_launch({.kernel = "rdb_tiles", .group = {16, 1}});

int reach_of(const Frame& frame, const RadiusBins& bins, const RayPlan& plan) {
  const std::int32_t largest = std::max(std::abs(bins.least), std::abs(bins.largest));
  const int rays = std::min(rdb_reach(largest), std::max(frame.width, frame.height));
  return plan.sparse_from[0] > 0 ? std::max(rays, sparse_reach_px) : rays;
}

template <typename T>
void read_all(Session& session, const cl::Buffer& buffer, std::size_t count, std::vector<T>& to) {
  to.resize(count);
  session.read(buffer, to.data(), count * sizeof(T));
}

}  // namespace

RayTileWindow::RayTileWindow(Session& session, const Frame& frame, const RayPlan& plan,
                             const RadiusBins& bins)
    : session_(session), frame_(frame), plan_(plan), reach_px_(reach_of(frame, bins, plan)) {
  params.width = word(frame.width);
  params.layers = word(frame.layers);
  params.channels = static_cast<std::uint32_t>(frame.channels.size());
  params.stride = word(padded_stride(frame.width));
  params.tiles_x = word(ray_tiles_along(frame.width));
  params.reach_tiles = ray_tiles_along(reach_px_) + 1;
  params.first_bin = bins.first_bin;
  params.bin_shift = word(bins.shift);
  params.has_coverage = !frame.coverage.empty();
  params.has_rim = !plan.rim_x.empty();
  params.has_spans = plan.has_spans;
  params.origin_x = plan.origin_x;
  params.origin_y = plan.origin_y;
  near_ = bins_by_distance(bins, params.reach_tiles);
  near_on_device_ = session.view(near_);
}

std::vector<BandRows> RayTileWindow::windows() const {
  const std::size_t surfaces = params.stride * size(frame_.layers);
  return cut_into_windows(frame_.wanted_rows(), frame_.height, reach_px_ + span_rows(plan_),
                          DEFRAY_RAY_TILE, {surfaces * launch_of("rdb_pad").bytes_a_surface},
                          session_.memory_bytes() / 2);
}

void RayTileWindow::prepare(const BandRows& rows) {
  Band band(session_, "rdb_pad", frame_, rows);
  planes = {band.in(frame_.coc_quanta), band.in(frame_.depth), band.in(frame_.coverage),
            band.in(frame_.data_of), band.in(frame_.channels)};
  params.window_y = word(rows.window_y);
  params.window_rows = word(rows.window_rows);
  params.tiles_y = word(ray_tiles_along(rows.window_rows));
  const auto plane = [&](bool is_needed) {
    return session_.buffer((is_needed ? lines() * params.stride : 1) * sizeof(cl_int));
  };
  keys = plane(true);
  largest = plane(params.has_spans);
  sending = plane(params.has_coverage);
  coverage = plane(params.has_coverage);
  channels = four_channels(params.channels, [&](std::size_t) { return plane(true); });
  session_.launch("rdb_pad", {Lanes(session_).over_columns(params.stride), lines()}, params,
                  planes.coc, planes.depth, planes.coverage, planes.channels, keys, largest,
                  sending, coverage, channels);

  const std::size_t bytes = std::size_t{params.tiles_x} * params.tiles_y * sizeof(TileBins);
  tiles_ = session_.buffer(bytes);
  reach = session_.buffer(bytes);
  least_ = session_.buffer(bytes / sizeof(TileBins) * sizeof(cl_int));
  special_rows = session_.buffer(bytes / sizeof(TileBins) * sizeof(cl_uint));
  const cl::Buffer along_x = session_.buffer(bytes);
  const std::vector<std::size_t> all{params.tiles_x, params.tiles_y};
  DefrayRaysParams along_y = params;
  along_y.along_y = 1;
  session_.launch("rdb_tiles", all, params, keys, largest, coverage, tiles_, least_, special_rows);
  session_.launch("rdb_reach", all, params, near_on_device_, tiles_, along_x);
  session_.launch("rdb_reach", all, along_y, near_on_device_, along_x, reach);
  find_sparse_tiles();
}

TileWindow RayTileWindow::tiles() const {
  return {static_cast<int>(params.window_y), static_cast<int>(params.tiles_x),
          static_cast<int>(params.tiles_y)};
}

void RayTileWindow::find_sparse_tiles() {
  // It waits for all kernels before: none looks at the window's before any more.
  const std::size_t count = std::size_t{params.tiles_x} * params.tiles_y;
  session_.look_at<std::int32_t>(least_, count, [&](std::span<const std::int32_t> least) {
    sparse_tiles_ = sparse_tiles({least.begin(), least.end()}, tiles(), frame_, plan_);
  });
  sparsity = session_.view(sparse_tiles_);
}

RayTiles RayTileWindow::read() {
  const std::size_t surfaces = lines() * params.stride;
  RayTiles out;
  read_all(session_, keys, surfaces, out.padded.keys);
  if (params.has_spans) read_all(session_, largest, surfaces, out.padded.largest);
  if (params.has_coverage) {
    read_all(session_, sending, surfaces, out.padded.sending);
    read_all(session_, coverage, surfaces, out.padded.coverage);
  }
  for (std::size_t c = 0; c < params.channels; ++c) {
    read_all(session_, channels[c], surfaces, out.padded.channels.emplace_back());
  }
  const std::size_t tiles = std::size_t{params.tiles_x} * params.tiles_y;
  read_all(session_, tiles_, tiles, out.held);
  read_all(session_, reach, tiles, out.reach);
  read_all(session_, least_, tiles, out.least);
  read_all(session_, special_rows, tiles, out.special_rows);
  return out;
}

RayTiles DeviceBackend::ray_tiles(const Frame& frame, const RayPlan& plan) {
  RayTileWindow window(session_, frame, plan, bins_of(frame));
  window.prepare({0, frame.height, 0, frame.height});
  return window.read();
}

}  // namespace defray
