#pragma once
// The stages' surfaces as sources of the ray distribution buffers.
#include "chain/border.h"
#include "rdb/fragments.h"

namespace defray {

/// One fragment a pixel, whole; those of the margin were not seen. Takes the frame's planes.
Fragments whole_pixels(ExtendedFrame& frame);

/// Two layers. `report` gets how many pixels of the frame were split and have something made up
/// behind them. Empties the frame's planes.
Fragments assemble(ExtendedFrame& frame, Surfaces surfaces, DefocusReport& report);

}  // namespace defray
