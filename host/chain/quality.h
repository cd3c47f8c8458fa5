#pragma once
// Between fast and right.
#include <vector>

#include "defray/options.h"

namespace defray {

/// A quality, with as many lens points as round cells of such a grid.
struct Rung {
  Quality quality = Quality::preview;
  int cells_per_side = 0;
  bool operator==(const Rung&) const = default;
};

/// The qualities and what lies between them, from the fastest to the one with the least error.
const std::vector<Rung>& rungs();

/// What a rung says, all else as it is.
ChainSettings with_rung(ChainSettings chain, const Rung& rung);

}  // namespace defray
