#pragma once
// A camera file, of commands that have no report to put its notes into.
#include <string>

#include "lens/camera.h"

namespace defray::cli {

/// A note on a camera file, for a command that has no option of its own for the fields it names.
std::string beside_render(const std::string& note);

/// read_camera_json, what is odd about the file said on standard error.
CameraValues read_camera_file(const std::string& path, const std::string& focus_setting,
                              double metres_per_unit);

}  // namespace defray::cli
