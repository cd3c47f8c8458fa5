#pragma once
// Depth as files hold it -> planar depth in scene units, with the background told apart.
#include <cstddef>
#include <optional>
#include <string>

#include "base/plane.h"
#include "image/image_file.h"

namespace defray {

enum class DepthKind {
  z,           ///< Planar, along the camera's axis.
  distance,    ///< Along the ray from the camera.
  inverse,     ///< 1 / planar depth.
  normalized,  ///< 0 at `near`, 1 at `far`, linear in planar depth.
};

struct DepthSettings {
  DepthKind kind = DepthKind::z;
  bool invert = false;    ///< normalized: 1 at near, 0 at far.
  double near_units = 0;  ///< normalized only.
  double far_units = 0;
  /// The stored value that means "nothing there". Empty: 65504, anything >= 1e9, inf and <= 0.
  std::optional<double> background;
};

struct DepthReport {
  std::size_t background = 0;     ///< Pixels taken as background.
  std::size_t not_a_number = 0;   ///< NaN pixels, taken as background too.
  std::size_t outside_range = 0;  ///< normalized: stored values outside 0...1.
  double nearest_units = 0;       ///< Range of the rest; 0 where nothing is left.
  double farthest_units = 0;
};

/// Converts `depth` in place to planar depth > 0, +inf for background. `data` and `display` are the
/// picture's windows: distances along rays need the pixel's place in the frame.
/// Throws Error(input), naming the file and the pixel, where a depth makes no sense.
DepthReport convert_depth(Plane& depth, const DepthSettings& settings, const Window& data,
                          const Window& display, double pixel_focal_length,
                          const std::string& path);

/// Throws Error(usage) on settings that contradict each other.
void validate(const DepthSettings& settings);

}  // namespace defray
