#pragma once
// Poisson-disk gather (Glatzel & Wilhelm) on OpenCL: as published, or aware of depth.
#include <array>
#include <cstdint>
#include <vector>

#include "defray/options.h"
#include "frame/frame.h"
#include "kernels/methods_params.h"

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

/// One pass: all fields of the parameters but the window and the band.
DefrayGatherParams gather_params(const GatherSettings& settings, int width, int pass);

/// Whole pixels of the largest radius: rows in reach, but for those of the launch table.
int gather_reach_px(const Frame& frame);

/// The tiles of a frame, each as a pixel of a frame of its own, without planes.
Frame gather_tiles_of(const Frame& frame);

/// Tiles of a frame, and how many of them a CoC of this size spans.
DefrayTileParams tile_params(int width, int height, std::int32_t largest_coc_quanta);

}  // namespace defray
