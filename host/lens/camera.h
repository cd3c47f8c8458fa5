#pragma once
// Lens data from where pipelines keep them: an eye, camera.json (camera_metadata: image files).
#include <optional>
#include <string>
#include <vector>

#include "base/window.h"
#include "defray/splat.h"
#include "lens/lens.h"

namespace defray {

/// The two eyes of the papers: aperture and image distance, and the pixels that stand for a metre
/// of retina.
enum class Eye {
  retina,   ///< Glatzel & Wilhelm: 4.6 mm, 17 mm, 28000 px/m by calibration.
  display,  ///< Krivanek & Zara 2003: 4 mm, 24 mm, seen on a display at a distance.
};

/// Lens values of an eye. For Eye::display the retina's pixels are those of the display: its
/// resolution (px per metre) times viewing distance over image distance.
CameraValues eye_values(Eye eye, double display_distance_m, double display_px_per_metre);

/// A camera.json: focal_length_mm, sensor_width_mm, and focus_settings {name: {focus_distance_m,
/// f_stop or aperture_diameter_m}}, and instead of the sensor's width sensor_height_mm or fov_deg,
/// with sensor_fit (horizontal, vertical, auto). `setting` picks one of several. Unknown keys are
/// in the values' notes. Throws Error(input).
CameraValues read_camera_json(const std::string& path, const std::string& setting,
                              double metres_per_unit);

/// Where a camera.json says that the camera stands: from_m, look_at_m and up, three numbers each.
/// Empty where it says nothing of it; throws Error(input) where it says it in part.
std::optional<CameraPose> read_camera_pose(const std::string& path, double metres_per_unit);
std::optional<CameraPose> parse_camera_pose(const std::string& text, const std::string& path,
                                            double metres_per_unit);

/// The same of a text; `path` is what messages call it.
CameraValues parse_camera_json(const std::string& text, const std::string& path,
                               const std::string& setting, double metres_per_unit);

/// Notes on values ten times off those of any real lens.
std::vector<std::string> notes_on_extremes(const CameraValues& values);

/// A note where a sensor's width spans the shorter side of an upright frame, and nothing says that
/// it is to: Blender's Auto means the longer one. Else empty.
std::string note_on_upright(const CameraValues& values, const Window& display);

/// The lens these values describe; 36 mm sensor width by default. A sensor that spans the frame's
/// height, or a longer side that this is, needs the display window's shape. Throws Error(usage)
/// that names every value that is missing or contradicts another.
Lens make_lens(const CameraValues& values, double metres_per_unit, LensModel model,
               double max_coc_px, const Window& display = {0, 0, 1, 1});

}  // namespace defray
