#pragma once
// A camera file, of commands that have no report to put its notes into.
#include <string>

#include "lens/camera.h"

namespace defray::cli {

/// read_camera_json, what is odd about the file said on standard error.
CameraValues read_camera_file(const std::string& path, const std::string& focus_setting,
                              double metres_per_unit);

}  // namespace defray::cli
