#pragma once
// The main job in memory: a pinhole picture with depth in, the lens picture out.
#include <cstddef>

#include "base/window.h"
#include "defray/report.h"
#include "frame/backend.h"
#include "lens/lens.h"
#include "methods/method.h"
#include "methods/tiltshift.h"

namespace defray {

/// A picture and what is to be made of it.
struct RenderJob {
  Frame frame;  ///< Channels and, but for a tilt-shift, depth.
  Window data, display;
  Lens lens;  ///< Not of a tilt-shift.
  MethodSettings method;
  TiltshiftSettings tiltshift;
  bool wants_nearest = false;  ///< MethodResult::nearest.
};

struct Rendered {
  MethodResult result;
  Frame frame;                                     ///< As it went into the method, with the CoC.
  double nearest_coc_px = 0, farthest_coc_px = 0;  ///< Signed radii: smallest and largest.
  std::size_t coc_limited = 0;                     ///< Pixels whose CoC the limit cut.
};

/// What `rendered` tells, for a report.
void describe(const Rendered& rendered, const MethodSettings& method, RenderReport& report);

/// Throws Error.
Rendered render(RenderJob job, Backend& backend, const Progress& progress = {});

}  // namespace defray
