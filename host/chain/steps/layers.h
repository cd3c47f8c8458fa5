#pragma once
// What the stages have found out about a frame, as the one or two layers that rays come from.
#include "defray/report.h"
#include "frame/backend.h"

namespace defray {

/// One surface a pixel, whole; those of the margin were not seen: depth and coverage of wanted
/// rows.
void make_whole(Frame& frame);

/// Gives the layers of `split` data_of where `frame`, which they were made of, has it. `report`
/// gets how many pixels of the picture were split and have something made up behind them. Of the
/// layers' wanted rows.
void describe_layers(const Frame& frame, Frame& layers, ChainReport& report);

}  // namespace defray
