#pragma once
// Built-in point clouds.
#include <string>

#include "defray/splat.h"

namespace defray {

/// As make_point_cloud(), which shows it to the library's users.
PointCloud model_cloud(const std::string& name, std::size_t points);

}  // namespace defray
