#pragma once
// The lens, of every command that has one.
#include <string>
#include <vector>

#include "lens/camera.h"
#include "options/option_table.h"

namespace defray::cli {

/// What --camera is for the image's own metadata; no file is called so.
inline const std::string from_metadata = "from-metadata";

/// Focus, aperture, focal length, sensor; `unit` is that of the focus distance.
std::vector<OptionRow> lens_rows(CameraValues& camera, const std::string& unit);

/// --camera and --focus-setting. `others` says what else --camera can be than a file.
std::vector<OptionRow> camera_rows(std::string& file, std::string& focus_setting,
                                   const std::string& others);

}  // namespace defray::cli
