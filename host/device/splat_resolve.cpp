// Kernel `splat_resolve`.
#include "base/parallel.h"
#include "device/device_backend.h"
#include "opencl/launch_table.h"
#include "splat/splats.h"

namespace defray {
namespace {

const LaunchRow splat_resolve_launch({.kernel = "splat_resolve", .group = {4, 4}});

/// Entries of tiles' lists that are made together, as bytes: the rest waits for its turn.
constexpr std::size_t list_bytes = std::size_t{64} << 20;

/// Colour, depth and count. Memory that other threads ask for is given back with them, and comes
/// anew, page by page, for the next picture.
std::array<Values<float>, 6> zeroed_planes(std::size_t pixels) {
  std::array<Plane, 6> planes;
  for (Plane& plane : planes) plane.reserve(pixels);
  parallel_for(6, [&](int i) { planes[size(i)].resize(pixels); });
  std::array<Values<float>, 6> values;
  for (std::size_t i = 0; i < 6; ++i) values[i] = Values<float>(std::move(planes[i]));
  return values;
}

}  // namespace

SplatPlanes DeviceBackend::splat_resolve(const Splats& splats, const DefraySplatParams& params,
                                         const Progress& progress) {
  const std::uint32_t tiles_x = (params.width + DEFRAY_SPLAT_TILE - 1) / DEFRAY_SPLAT_TILE;
  const std::uint32_t tiles_y = (params.height + DEFRAY_SPLAT_TILE - 1) / DEFRAY_SPLAT_TILE;
  const std::size_t pixels = std::size_t{params.width} * params.height;
  std::array<Values<float>, 6> planes;
  // Vectors from the start, where the device works in them: room would have to be copied to some.
  const bool in_place = session_.works_in_host_memory();
  if (in_place) planes = zeroed_planes(pixels);
  const auto out = [&](Values<float>& plane) {
    return in_place ? session_.in_out(plane) : session_.out(plane, pixels);
  };
  std::array<cl::Buffer, 4> colour;
  for (std::size_t c = 0; c < 4; ++c) colour[c] = out(planes[c]);
  const cl::Buffer depth = out(planes[4]), count = out(planes[5]);
  const cl::Buffer in = session_.in(splats.all), lines = session_.in(splats.lines);
  const auto counts =
      splats_a_tile(splats.all, static_cast<int>(tiles_x), static_cast<int>(tiles_y));
  const std::size_t most = std::min(list_bytes, session_.memory_bytes()) / sizeof(std::uint32_t);
  for (std::uint32_t tile = 0; tile < counts.size();) {
    SplatTiles tiles = next_tiles(splats.all, counts, static_cast<int>(tiles_x), tile, most);
    if (tiles.list.empty()) tiles.list.push_back(0);
    const DefraySplatTileParams p{params.width, params.height,    tiles_x,
                                  tile,         tiles.tile_count, params.cutoff,
                                  params.edge,  params.averages,  params.layers};
    session_.launch("splat_resolve", {tiles.tile_count, DEFRAY_SPLAT_SQUARES}, p, in, lines,
                    session_.view(tiles.first), session_.view(tiles.list), colour, depth, count);
    session_.finish();  // before the lists go
    tile += tiles.tile_count;
    if (progress) progress(static_cast<double>(tile) / static_cast<double>(counts.size()));
  }
  SplatPlanes made;
  for (std::size_t c = 0; c < 4; ++c) made.colour.push_back(std::move(planes[c]).take());
  made.depth = std::move(planes[4]).take();
  made.fragments = std::move(planes[5]).take();
  return made;
}

}  // namespace defray
