// Twins of kernels/rdb/rdb_tiles.cl.
#include <algorithm>
#include <cstdlib>
#include <limits>

#include "reference/pcg3d.h"
#include "reference/reference.h"

namespace defray::reference {
namespace {

void add_bin(BinSet& set, int bin) { set[size(bin / 64)] |= std::uint64_t{1} << (bin % 64); }
bool has_bin(const BinSet& set, int bin) { return (set[size(bin / 64)] >> (bin % 64)) & 1; }

/// The last bin that begins at or before a radius.
int bin_of(const RadiusBins& bins, std::int32_t radius) {
  int bin = DEFRAY_RAY_BINS - 1;
  while (bin > 0 && bins.first_radius(bin) > radius) --bin;
  return bin;
}

bool is_there(const Frame& f, std::size_t surface) {
  const bool has_share = f.coverage.empty() || (f.coverage[surface] & ~DEFRAY_SYNTHESISED) != 0;
  return is_fragment(f.depth[surface]) && has_share;
}

/// Copies surface (x, y, layer) to its place `to`.
void pad(const Frame& f, const RayPlan& plan, int x, int y, std::size_t surface, std::size_t to,
         PaddedPlanes& out) {
  if (is_there(f, surface)) {
    const Span span = span_of(f, plan, surface);
    out.keys[to] = span.least;
    if (plan.has_spans) out.largest[to] = span.largest;
  }
  for (std::size_t c = 0; c < f.channels.size(); ++c) {
    out.channels[c][to] = f.channels[c][surface];
  }
  if (f.coverage.empty()) return;
  out.coverage[to] = f.coverage[surface];
  const std::uint32_t share = f.coverage[surface] & ~DEFRAY_SYNTHESISED;
  const std::uint32_t turn = pcg3d(static_cast<std::uint32_t>(x + plan.origin_x),
                                   static_cast<std::uint32_t>(y + plan.origin_y), 0)[2];
  if (!is_there(f, surface)) return;
  out.sending[to] = (share == DEFRAY_WHOLE ? 0 : turn % 65536) + 65536 * (share - 1);
}

PaddedPlanes padded(const Frame& f, const RayPlan& plan) {
  const std::size_t stride = size(padded_stride(f.width));
  const std::size_t rows = size(f.height + 2 * DEFRAY_RAY_TILE);
  const std::size_t count = stride * rows * size(f.layers);
  const std::size_t shares = f.coverage.empty() ? 0 : count;
  PaddedPlanes out{std::vector<std::int32_t>(count, DEFRAY_NO_KEY),
                   std::vector<std::int32_t>(plan.has_spans ? count : 0, DEFRAY_NO_KEY),
                   std::vector<std::uint32_t>(shares), std::vector<std::uint32_t>(shares),
                   std::vector<std::vector<float>>(f.channels.size(), std::vector<float>(count))};
  for (int layer = 0; layer < f.layers; ++layer) {
    for (int y = 0; y < f.height; ++y) {
      const std::size_t row = size(layer) * rows + size(y + DEFRAY_RAY_TILE);
      for (int x = 0; x < f.width; ++x) {
        pad(f, plan, x, y, f.index(x, y, layer), row * stride + size(x + DEFRAY_RAY_RUN), out);
      }
    }
  }
  return out;
}

/// What a tile's pixels hold.
TileBins held_by(const Frame& f, const RayPlan& plan, const RadiusBins& bins, int tile_x,
                 int tile_y) {
  TileBins held;
  constexpr int side = DEFRAY_RAY_TILE;
  for (int y = tile_y * side; y < std::min(f.height, (tile_y + 1) * side); ++y) {
    for (int x = tile_x * side; x < std::min(f.width, (tile_x + 1) * side); ++x) {
      for (int layer = 0; layer < f.layers; ++layer) {
        const std::size_t i = f.index(x, y, layer);
        if (!is_there(f, i)) continue;
        const bool is_whole = f.coverage.empty() || f.coverage[i] == DEFRAY_WHOLE;
        const Span span = span_of(f, plan, i);
        for (int b = bin_of(bins, span.least); b <= bin_of(bins, span.largest); ++b) {
          add_bin(layer == 0 && is_whole ? held.plain : held.special, b);
        }
      }
    }
  }
  return held;
}

/// The least |radius| of a tile's pixels, 0 where the front has none.
std::int32_t least_of(const Frame& f, const RayPlan& plan, int tile_x, int tile_y) {
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  constexpr int side = DEFRAY_RAY_TILE;
  for (int y = tile_y * side; y < std::min(f.height, (tile_y + 1) * side); ++y) {
    for (int x = tile_x * side; x < std::min(f.width, (tile_x + 1) * side); ++x) {
      for (int layer = 0; layer < f.layers; ++layer) {
        const std::size_t i = f.index(x, y, layer);
        if (!is_there(f, i)) {
          if (layer == 0) return 0;
          continue;
        }
        const Span span = span_of(f, plan, i);
        const bool has_zero = span.least <= 0 && span.largest >= 0;
        const std::int32_t nearest = std::min(std::abs(span.least), std::abs(span.largest));
        least = std::min(least, has_zero ? 0 : nearest);
      }
    }
  }
  return least;
}

/// Whether a pixel holds others than one whole surface that was seen.
bool is_special(const Frame& f, int x, int y) {
  for (int layer = 0; layer < f.layers; ++layer) {
    const std::size_t i = f.index(x, y, layer);
    const bool is_plain = layer == 0 && (f.coverage.empty() || f.coverage[i] == DEFRAY_WHOLE);
    if (is_there(f, i) && !is_plain) return true;
  }
  return false;
}

/// Rows of a tile that hold such pixels, a bit each.
std::uint32_t special_rows_of(const Frame& f, int tile_x, int tile_y) {
  constexpr int side = DEFRAY_RAY_TILE;
  std::uint32_t rows = 0;
  for (int y = tile_y * side; y < std::min(f.height, (tile_y + 1) * side); ++y) {
    for (int x = tile_x * side; x < std::min(f.width, (tile_x + 1) * side); ++x) {
      if (is_special(f, x, y)) rows |= 1u << (y % side);
    }
  }
  return rows;
}

/// Pixels between two tiles at least, along the axis on which they are farther apart.
int gap_px(int tile_a, int tile_b, int across) {
  const int x = std::abs(tile_a % across - tile_b % across);
  const int y = std::abs(tile_a / across - tile_b / across);
  return std::max(std::max(x, y) - 1, 0) * DEFRAY_RAY_TILE;
}

}  // namespace

RayTiles ray_tiles(const Frame& f, const RayPlan& plan) {
  const RadiusBins bins = bins_of(f);
  const int across = ray_tiles_along(f.width), down = ray_tiles_along(f.height);
  RayTiles out;
  out.padded = padded(f, plan);
  for (int i = 0; i < across * down; ++i) {
    out.held.push_back(held_by(f, plan, bins, i % across, i / across));
    out.least.push_back(least_of(f, plan, i % across, i / across));
    out.special_rows.push_back(special_rows_of(f, i % across, i / across));
  }
  for (int here = 0; here < across * down; ++here) {
    TileBins reach;
    for (int there = 0; there < across * down; ++there) {
      for (int b = 0; b < DEFRAY_RAY_BINS; ++b) {
        if (bins.largest_of(b) / 256 + 1 < gap_px(here, there, across)) continue;
        if (has_bin(out.held[size(there)].plain, b)) add_bin(reach.plain, b);
        if (has_bin(out.held[size(there)].special, b)) add_bin(reach.special, b);
      }
    }
    out.reach.push_back(reach);
  }
  return out;
}

}  // namespace defray::reference
