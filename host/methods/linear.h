#pragma once
// Linear filtering (Potmesil & Chakravarty 1981; Shinya 1994, eq. 5) on OpenCL.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lens/coc.h"

namespace defray {

/// Largest CoC radius that `linear` takes: its cost grows with the square.
inline constexpr int linear_max_radius_px = 1024;

struct LinearSettings {
  std::size_t memory_bytes = default_memory_bytes;  ///< For one band's planes.
};

/// Every pixel spread over its circle of confusion, nothing occluded. A pixel's shares add up to 1:
/// what does not leave the frame is conserved. Outside the frame its edge pixels repeat, colour and
/// CoC, and send their light in. 1 to 4 channels in, as many out.
/// Throws Error(usage) for a CoC above linear_max_radius_px, or when a row exceeds the memory.
std::vector<Plane> render_linear(Session& session, int width, int height,
                                 const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels, const LinearSettings& settings,
                                 const std::function<void(double)>& progress = {});

/// Memory for a band of so many rows.
std::size_t linear_band_bytes(int width, int reach, int rows);

/// Reach of `linear`, in whole pixels, for these CoC radii. Throws Error(usage) above the limit.
int linear_reach(const std::vector<std::int32_t>& coc_quanta);

}  // namespace defray
