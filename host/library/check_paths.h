#pragma once
// What can be said of a frame's files before any work.
#include <string>
#include <vector>

#include "defray/io.h"

namespace defray {

/// Throws Error(usage) where an output is an input, or two are one file. `also_read`: further files
/// that must stay as they are.
void check_paths(const FramePaths& paths, const std::vector<std::string>& also_read);

/// Throws Error unless the outputs can be written.
void check_outputs(const FramePaths& paths, const RenderSettings& settings);

/// Makes the outputs' folders where there are none. Throws Error(output).
void make_folders(const FramePaths& paths);

}  // namespace defray
