#pragma once
// What scans have met beside surfaces: dust, and what lies between two depths.
#include <cstdint>
#include <vector>

#include "splat/surfels/cloud_points.h"

namespace defray {

/// Which of the points that may be strays are some: around them there is no surface, or one that
/// they lie far above.
std::vector<std::uint8_t> find_strays(const CloudPoints& cloud,
                                      const std::vector<std::uint8_t>& may_be);

}  // namespace defray
