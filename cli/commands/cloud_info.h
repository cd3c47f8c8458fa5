#pragma once
// What defray info tells of a point cloud.
#include <string>

namespace defray::cli {

/// Prints its points, where they lie, what they have, and a command that draws them. Throws
/// Error(input).
void print_cloud_info(const std::string& path, bool json);

}  // namespace defray::cli
