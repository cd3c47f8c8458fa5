#pragma once
// The lens picture, closer to the truth than the rays of visible pixels alone: what lies behind
// near surfaces, mixed pixels, highlights, borders. A chain of stages before and after the ray
// distribution buffers; those that guess can be left out.
#include <cstdint>
#include <vector>

#include "chain/tiles/tile_classes.h"
#include "defray/options.h"
#include "defray/report.h"
#include "frame/backend.h"
#include "lens/aperture.h"

namespace defray {

/// What a method gives.
struct MethodResult {
  std::vector<Plane> colour;
  /// Share of each pixel's lens rays that end on what the picture shows, 0 to 1. Of the chain.
  Plane confidence = {};
  /// The pixel whose data (ids, normals) each pixel gets: that of the nearest surface its rays end
  /// on, made-up ones left out; its own where there is none. Of rays, if wanted.
  std::vector<std::uint32_t> nearest = {};
  /// Of the chain.
  TileClasses tiles = {};
  std::optional<ChainReport> report = {};
};

/// `frame` has coc_quanta, depth and channels. Throws Error(usage)
/// for settings out of range.
MethodResult run_chain(const Frame& frame, const ChainSettings& settings, Backend& backend,
                       bool wants_nearest = false, const Progress& progress = {});

}  // namespace defray
