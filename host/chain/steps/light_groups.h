#pragma once
// Highlights that lie together and are blurred alike, as one source.
#include "rdb/light_sources.h"

namespace defray {

/// Makes pixels of one square (2 or 4 px a side, the larger the more they are blurred, counted from
/// the frame's first pixel) and of about the same CoC one source: the box around them, its CoC and
/// light the means of theirs, so that nothing of the light is lost. `highlights_add` takes as long
/// for it as for one of them. Sources that are alone stay as they are.
void group_lights(LightSources& lights);

}  // namespace defray
