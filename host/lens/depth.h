#pragma once
// Depth as files hold it -> planar depth in scene units, with the background told apart.
#include <string>

#include "base/plane.h"
#include "base/window.h"
#include "defray/options.h"
#include "defray/report.h"

namespace defray {

/// Stored depths that mean background, where nothing else is said: renderers write the largest half
/// float, or more than any scene has.
inline constexpr double largest_half = 65504, far_away = 1e9;

/// Whether a stored finite number says that there is nothing.
bool is_background(double stored, const DepthSettings& settings);

/// Converts `depth` in place to planar depth > 0, +inf for background. `data` and `display` are the
/// picture's windows: distances along rays need the pixel's place in the frame.
/// Throws Error(input), naming the file and the pixel, where a depth makes no sense.
DepthReport convert_depth(Plane& depth, const DepthSettings& settings, const Window& data,
                          const Window& display, double pixel_focal_length,
                          const std::string& path);

/// The same for a picture that this lens takes. Throws Error(usage) too, where distances along rays
/// cannot be told from the lens.
DepthReport convert_depth(Plane& depth, const DepthSettings& settings, const Window& data,
                          const Window& display, const Lens& lens, const std::string& path);

/// Throws Error(usage) on settings that contradict each other.
void validate(const DepthSettings& settings);

}  // namespace defray
