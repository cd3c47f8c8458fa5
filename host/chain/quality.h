#pragma once
#include "defray/options.h"

namespace defray {

/// What a quality says, all else as it is.
ChainSettings with_quality(ChainSettings chain, Quality quality);

}  // namespace defray
