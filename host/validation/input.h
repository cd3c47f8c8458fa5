#pragma once
// The planes that a case stands for.
#include <cstdint>
#include <vector>

#include "frame/frame.h"
#include "lens/lens.h"
#include "validation/case.h"

namespace defray::validation {

/// Planes of width x height. CoC and depth are laid out alike, but neither follows from the other:
/// stages are tested one by one.
struct Input {
  std::vector<std::int32_t> coc_quanta;  ///< |coc| <= the case's largest.
  Plane depth;                           ///< > 0, some +inf.
  std::vector<Plane> channels;
  /// The same, with a second surface behind some pixels and shares of them in others; whole pixels
  /// only for every third seed.
  Frame fragments;
  Lens lens;  ///< Its background CoC is the case's largest (for focus at infinity: at depth 1).
};

Input make_input(const Case& c);

/// The input's planes as a frame, which must not outlive it.
Frame frame_of(const Case& c, const Input& in);

}  // namespace defray::validation
