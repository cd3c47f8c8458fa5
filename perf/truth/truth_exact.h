#pragma once
// A scene's surfaces, exactly as they are: what the chain must guess.
#include "truth/truth.h"

namespace defray::perf {

/// A setup with all that lies around the frame as far as its lens brings it in.
struct Wide {
  const Setup& setup;
  int margin;
  Subject subject;  ///< Anti-aliased.
  Coverage exact;
  Words mixed;
  /// Where the chain looks for hidden surfaces: elsewhere they would only show through the small
  /// gaps between the rays of a slanting surface.
  std::vector<std::uint8_t> is_uncovered;
};

Wide make_wide(const Bench& bench, const Setup& setup);

/// Surfaces and coverage as they are, in two layers.
Frame exact_surfaces(const Bench& bench, const Wide& wide);

/// The same, but mixed pixels taken apart as the chain does it.
Frame split_surfaces(const Bench& bench, const Wide& wide);

}  // namespace defray::perf
