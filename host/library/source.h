#pragma once
// A picture read, ready for the lens.
#include <string>
#include <vector>

#include "base/plane.h"
#include "defray/io.h"
#include "image/channels.h"
#include "image/further_channels.h"
#include "image/image_file.h"

namespace defray {

struct Source {
  ImageFile file;
  ColourChoice choice;
  std::vector<Plane> colour;
  Plane depth;
  FurtherChannels further = {};
  const PartInfo& part() const { return file.parts()[static_cast<std::size_t>(choice.part)]; }
};

/// Reads a frame, chooses its channels, and fills in what the report says of them, of depth and of
/// the lens. Throws Error.
Source read_source(const FramePaths& paths, const RenderSettings& settings, FrameReport& report);

/// Planes of these channels, and what was not finite in them.
std::vector<Plane> read_planes(const Source& source, const std::vector<int>& channels,
                               const RenderSettings& settings, std::vector<std::string>& names,
                               FrameReport& report);

/// R G B A, or Y A.
inline bool has_alpha(const std::vector<Plane>& colour) { return colour.size() % 2 == 0; }

}  // namespace defray
