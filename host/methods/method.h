#pragma once
// The methods, behind one call: a frame with its circles of confusion in, the lens picture out.
#include "chain/chain.h"
#include "defray/options.h"
#include "frame/backend.h"
#include "methods/gather.h"
#include "rdb/rdb.h"

namespace defray {

/// Throws Error(usage) for enumerations and counts out of range, whatever the method; what a method
/// has of its own it looks at itself.
void validate(const MethodSettings& settings);

/// The lens picture, as many channels as there are, and what the method tells beside it. `frame`
/// has coc_quanta, channels and, for the RDB, depth. Throws Error(usage) for settings out of range.
MethodResult apply_method(const Frame& frame, const MethodSettings& settings, Backend& backend,
                          bool wants_nearest = false, const Progress& progress = {});

}  // namespace defray
