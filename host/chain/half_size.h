#pragma once
// The chain at half the size, for previews: a quarter of the pixels, each CoC half as large. What
// that loses is the finest detail, of what is nearly in focus alone: it is put back from the
// pinhole picture, by as much of it as each pixel shows.
#include "chain/chain.h"
#include "chain/half_frame.h"

namespace defray {

/// As run_chain; pixels of `nearest` are the frame's.
MethodResult run_half_size(const Frame& frame, const ChainSettings& settings, Backend& backend,
                           bool wants_nearest = false, const Progress& progress = {});

}  // namespace defray
