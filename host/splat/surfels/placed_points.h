#pragma once
// Which points of a cloud are used.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "defray/splat.h"

namespace defray {

/// Farther from the cloud's origin, or larger, floats' squares and areas of pixels overflow.
inline constexpr float most_units = 1e15f;

bool is_finite(const std::array<float, 3>& v);

/// The points that have a place, in their order, and of more than neighbour_count in one place the
/// first; adds notes on what is left out. Throws Error(input) where none is left, or one lies too
/// far away.
std::vector<std::uint32_t> placed_points(const PointCloud& cloud, std::vector<std::string>& notes);

}  // namespace defray
