#pragma once
// A pinhole picture in memory as a method takes it: with the CoC of each pixel.
#include "base/window.h"
#include "defray/options.h"
#include "defray/report.h"
#include "frame/backend.h"
#include "lens/lens.h"

namespace defray {

struct PinholePicture {
  Planes channels;           ///< Linear colour, premultiplied; the last of two or four is alpha.
  Values<float> depth = {};  ///< Planar, > 0, inf: background. A tilt-shift needs none.
  Window data, display;
};

/// Tells the report of the radii.
Frame lens_frame(PinholePicture picture, const Lens& lens, Backend& backend, RenderReport& report);

/// Radii of a tilt-shift: by the row alone.
Frame lens_frame(PinholePicture picture, const TiltshiftSettings& tiltshift, Backend& backend,
                 RenderReport& report);

/// What work-groups are tuned for.
std::string class_of(const Frame& frame, const RenderReport& report);

}  // namespace defray
