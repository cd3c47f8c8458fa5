#pragma once
// Poisson-disk gather (Glatzel & Wilhelm) on OpenCL: as published, or aware of depth.
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/params.h"

namespace defray {

enum class GatherKind {
  literal,  ///< The paper: each pixel averages within its own CoC, and bleeds.
  aware,    ///< Each sample is weighed by whether its light arrives.
};

struct GatherSettings {
  GatherKind kind = GatherKind::aware;
  int samples = 32;     ///< A pass, a pixel.
  int passes = 2;       ///< The paper's count; later passes work on the result of the one before.
  bool rotate = false;  ///< Turns each pixel's samples by an angle of its own.
  std::uint32_t seed = 0;
};

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
