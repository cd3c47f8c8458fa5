#pragma once
// What is taken to be outside the frame: a margin around it.
#include "chain/chain.h"
#include "frame/frame.h"

namespace defray {

/// The frame with its edge pixels repeated around it, for Border::black without their light, as far
/// as rays can come in: the largest CoC on the edge, at most half the frame. With `inverse` instead
/// of depth, and data_of if `wants_data`. `report` gets how far.
Frame extended(const Frame& frame, Border border, bool wants_data, ChainReport& report);

/// Front surfaces of a margin made by Border::clamp: at distance d each has the mean colour of the
/// d pixels inside that begin at the edge and are of its surface. The edge's own colour says ever
/// less the farther out; repeated, what happens to be on it made streaks. Not finite: as it was.
void continue_colours(Frame& frame);

}  // namespace defray
