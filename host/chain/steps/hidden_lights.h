#pragma once
// Which lights anything may hide: the others need no map of the lens.
#include <vector>

#include "frame/frame.h"
#include "rdb/light_sources.h"

namespace defray {

/// Of each source, whether anything in these rows of the frame may hide a part of it: false where
/// every entry of its map (kernel `light_maps`) is 255, and of few others true.
std::vector<char> find_hidden_lights(const LightSources& lights, const Frame& frame, Rows rows);

}  // namespace defray
