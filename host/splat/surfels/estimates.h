#pragma once
// What a cloud does not say of its points, from those around.
#include <cstdint>
#include <string>
#include <vector>

#include "defray/splat.h"
#include "splat/surfels/cloud_points.h"

namespace defray {

/// Spacings of the points `kept`, given or from those around; of a single point there are none
/// around. Returns which are given, or as good as. Throws Error(input).
std::vector<std::uint8_t> set_spacings(const PointCloud& given_cloud,
                                       const std::vector<std::uint32_t>& kept, CloudPoints& cloud,
                                       std::vector<std::string>& notes);

/// Unit normals, given or estimated: where none is given, as find_sides() has them. Returns whether
/// any is.
bool set_normals(const PointCloud& given_cloud, const std::vector<std::uint32_t>& kept,
                 CloudPoints& cloud, std::vector<std::string>& notes);

}  // namespace defray
