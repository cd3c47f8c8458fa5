#pragma once
// The main job: one frame from file to file.
#include "defray/io.h"
#include "frame/stages.h"

namespace defray {

/// Renders one frame. Throws Error.
FrameResult render_frame(const FramePaths& paths, const RenderSettings& settings, Stages& stages,
                         const Progress& progress = {});

}  // namespace defray
