#pragma once
// What a predicted error is made of, in blocks of 4x4 pixels of a frame and its lens picture.
#include <array>
#include <vector>

#include "frame/frame.h"

namespace defray {

inline constexpr int block_px = 4;

/// Colours as a display gets them: sRGB-encoded, clipped to 0...1, of at most three channels.
struct ShownMoments {
  std::array<float, 3> mean{};
  float square = 0;  ///< Mean over pixels and channels.
};

/// Means over the pixels of a block. `gradient` is a squared one of shown values, central
/// differences; `grain` the squared difference to the mean of 3x3 pixels; both means over channels.
/// A surface's edge is where the CoC radius changes by a pixel or more from pixel to pixel.
struct PixelBlock {
  ShownMoments pinhole, result;
  float least_coc = 0, largest_coc = 0, mean_coc = 0;  ///< Signed radii, px.
  float reach = 0;                                     ///< Largest |radius|, px.
  float unseen = 0, unseen_square = 0;                 ///< Of 1 - confidence.
  float edge = 0;                                      ///< Share of its pixels that lie on one.
  /// Gradient of the result where it is beyond white, far beyond, and where nothing was seen.
  float rim = 0, bright_rim = 0, unseen_rim = 0;
  /// Of all else, by CoC radius, px: grain of the pinhole picture below 0.3, to 1, 2.5 to 6; the
  /// result's gradient from 0.3 to 2.5.
  float sharp_grain = 0, slight_grain = 0, soft_grain = 0, slight_gradient = 0;
  float edge_gradient = 0;  ///< Of the pinhole picture, on edges.
  float lost_grain = 0;     ///< Of all, by min(|radius|, 1).
};

/// Rows of blocks, all or some of a frame's.
struct PixelBlocks {
  int across, down;
  std::vector<PixelBlock> blocks;

  const PixelBlock& at(int x, int y) const { return blocks[size(y) * size(across) + size(x)]; }
};

/// How many rows of blocks a frame has.
inline int block_rows(const Frame& frame) { return (frame.height + block_px - 1) / block_px; }

/// Those of some rows of blocks. `result` and `confidence` are what the chain made of the frame.
PixelBlocks blocks_of(const Frame& frame, const std::vector<Plane>& result, const Plane& confidence,
                      Rows rows);

}  // namespace defray
