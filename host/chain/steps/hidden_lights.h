#pragma once
// Which lights anything may hide: the others need no map of the lens.
#include <cstdint>
#include <optional>
#include <vector>

#include "frame/frame.h"
#include "rdb/light_sources.h"

namespace defray {

/// Of each source the least CoC, in quanta, of what in these rows of the frame may hide a part of
/// it, or less. Empty where nothing may: every entry of its map (kernel `light_maps`) is 255.
std::vector<std::optional<std::int32_t>> find_hiding(const LightSources& lights, const Frame& frame,
                                                     Rows rows);

}  // namespace defray
