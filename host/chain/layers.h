#pragma once
// What the stages have found out about a frame, as the one or two layers that rays come from.
#include "chain/chain.h"
#include "frame/backend.h"

namespace defray {

/// One surface a pixel, whole; those of the margin were not seen. Depth instead of `inverse`.
Frame whole_pixels(Frame frame);

/// Two layers, with data_of where `frame` has it. `report` gets how many pixels of the picture were
/// split and have something made up behind them.
Frame two_layers(Backend& backend, const Frame& frame, const Surfaces& surfaces,
                 ChainReport& report);

}  // namespace defray
