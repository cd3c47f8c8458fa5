#pragma once
// The aperture as a picture of the light it lets through.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lens/aperture.h"

namespace defray {

/// side x side texels over the square [-1, 1]^2 of lens coordinates, row by row: first row v = -1,
/// first column u = -1.
struct ApertureMask {
  static constexpr int side = 512;
  /// 0: no light, 255: most light.
  std::vector<std::uint8_t> coverage;

  std::uint8_t at(int column, int row) const {
    return coverage[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
  }
};

/// Blades: the share of each texel that is open, from 8 x 8 points. A picture: the mean of its
/// linear luminance (Rec. 709) over each texel, brightest texel 255.
/// Throws what validate throws, and Error(input) on a picture that cannot be read or is black.
ApertureMask rasterise(const Aperture& aperture);

}  // namespace defray
