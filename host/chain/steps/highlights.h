#pragma once
// Small bright sources, taken out of the rays and added as discs of the aperture's shape.
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "lens/aperture_table.h"
#include "rdb/light_sources.h"

namespace defray {

/// Takes from the surfaces of wanted rows what `kept` (kernel `highlights`) does not leave them,
/// and of their alpha what they have more of than their surroundings, and adds it to `lights`: not
/// sorted into tiles. `alpha` is the last channel before anything was taken from it.
void take_light(Frame& frame, const Values<float>& kept, const Values<float>& alpha,
                int light_channels, LightSources& lights);

/// The aperture that the lights' discs have.
void show_through(const ApertureTable& aperture, LightSources& lights);

/// Lists sources by the tiles that their discs may meet, in a frame of this size.
void sort_into_tiles(LightSources& lights, int width, int height);

/// Those that shine on the frame's wanted rows from `reach` rows away at most, in groups and sorted
/// into tiles.
LightSources lights_near(const LightSources& all, const Frame& frame, int reach);

/// All of it, of a whole frame.
LightSources take_light(Frame& frame, const Values<float>& kept, int light_channels,
                        const ApertureTable& aperture);

}  // namespace defray
