#pragma once
// How the chain goes through a frame that does not fit the memory: band by band of rows, each stage
// as many rows ahead of the next as that looks at.
#include <cstddef>

#include "defray/options.h"
#include "frame/frame.h"

namespace defray {

/// Rows above and below its own that each stage looks at, at most; 0: it does not run.
struct ChainReach {
  int fill = 0, patterns = 0, highlights = 0, soften = 0, rays = 0;
  CocRange seen;  ///< Radii of the picture.
  CocRange all;   ///< Of what is made up behind it, too.
};

/// `frame` has coc_quanta.
ChainReach chain_reach(const Frame& frame, const ChainSettings& settings, int lens_points);

/// What the planes of all stages take at once, bytes, where bands have so many rows. `extended` is
/// the frame with its margin, of so many channels.
std::size_t bytes_of_bands(const Frame& extended, std::size_t channels, const ChainReach& reach,
                           int rows);

/// Rows of a band: all where they fit, or else as many as take half of the memory, whole steps of
/// band_step and one at least; the other half is left to kernels.
int chain_rows(const Frame& extended, std::size_t channels, const ChainReach& reach,
               std::size_t memory_bytes);

}  // namespace defray
