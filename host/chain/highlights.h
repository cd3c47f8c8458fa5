#pragma once
// Small bright sources, taken out of the rays and added as discs of the aperture's shape.
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "lens/aperture_table.h"
#include "lens/lens_points.h"
#include "rdb/light_sources.h"

namespace defray {

/// Takes from the surfaces what `kept` (kernel `highlights`) does not leave them, and of their
/// alpha what they have more of than their surroundings.
LightSources take_light(Frame& frame, const Values<float>& kept, int light_channels,
                        const ApertureTable& aperture, const LensPoints& lens);

/// For each of DEFRAY_CELL_MAP^2 squares over the lens's square the cell nearest to its centre.
std::vector<std::uint32_t> map_cells(const LensPoints& lens);

}  // namespace defray
