#pragma once
// How the chain goes through a frame that does not fit the memory: band by band of rows, each stage
// as many rows ahead of the next as that looks at.
#include <cstddef>

#include "defray/options.h"
#include "frame/frame.h"

namespace defray {

/// Rows above and below its own that each stage looks at, at most; 0: it does not run.
struct ChainReach {
  int silhouettes = 0, fill = 0, patterns = 0, highlights = 0, soften = 0, rays = 0;
  CocRange seen;  ///< Radii of the picture.
  CocRange all;   ///< Of what is made up behind it, too.
};

/// `frame` has coc_quanta.
ChainReach chain_reach(const Frame& frame, const ChainSettings& settings, int lens_points);

/// What planes hold, and how many.
struct PlaneCounts {
  std::size_t channels = 3;  ///< Alpha included.
  bool has_alpha = false, has_data = false;
};

/// How the chain goes through the frame.
struct ChainBands {
  int rows = 0;             ///< Of a band; all: there is one.
  bool gives_back = false;  ///< Whether rows that stages do not need any more are given back.
};

/// What the planes of all stages take at once, bytes. `extended` is the frame with its margin.
std::size_t bytes_of_bands(const Frame& extended, const PlaneCounts& planes,
                           const ChainReach& reach, const ChainBands& bands);

/// One band where it fits the memory, better one that gives nothing back: pages take time to come
/// again. Or else as many rows as take three quarters of it, whole steps of band_step and one at
/// least; the rest is left to kernels.
ChainBands chain_bands(const Frame& extended, const PlaneCounts& planes, const ChainReach& reach,
                       std::size_t memory_bytes);

}  // namespace defray
