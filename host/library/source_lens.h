#pragma once
// A frame's lens, and its depth as that lens sees it.
#include <string>

#include "defray/io.h"
#include "image/depth_plane.h"

namespace defray {

/// The frame that the lens's field of view spans. Throws Error(input) where `full_size` does not
/// hold the picture.
Window lens_window(const PartInfo& part, const RenderSettings& settings, const std::string& path);

/// Chooses the lens, converts the depth, and puts both, with what looks wrong about them, into the
/// report. Throws Error(usage), Error(input). `path` is that of the depth's file.
void take_lens(const ImageFile& file, const PartInfo& part, DepthPlane& depth,
               const RenderSettings& settings, const std::string& path, FrameReport& report);

}  // namespace defray
