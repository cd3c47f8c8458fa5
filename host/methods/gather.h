#pragma once
// Poisson-disk gather (Glatzel & Wilhelm) on OpenCL: as published, or aware of depth.
#include <array>
#include <cstdint>
#include <vector>

#include "defray/options.h"
#include "kernels/params.h"

namespace defray {

inline constexpr int gather_max_passes = 8;

/// Throws Error(usage) on counts outside 1...1024 samples and 1...8 passes.
void validate(const GatherSettings& settings);

/// What kernels and twins share as data. Coordinates in the unit disc.
struct GatherSamples {
  std::vector<std::array<float, 2>> points;
  std::vector<std::array<float, 2>> turns;  ///< (cos, sin) of DEFRAY_GATHER_ROTATIONS angles.
};
GatherSamples make_gather_samples(const GatherSettings& settings);

/// One pass over a whole frame: all fields of the parameters but the band.
DefrayGatherParams gather_params(const GatherSettings& settings, int width, int height, int pass);

/// Tiles of a frame, and how many of them a CoC of this size spans.
DefrayTileParams tile_params(int width, int height, std::int32_t largest_coc_quanta);

}  // namespace defray
