#pragma once
// Lens data from where pipelines keep them: camera.json and image metadata.
#include <optional>
#include <string>
#include <vector>

#include "image/image_file.h"
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
/// f_stop or aperture_diameter_m}}. `setting` picks one of several. Throws Error(input).
CameraValues read_camera_json(const std::string& path, const std::string& setting,
                              double metres_per_unit);

/// The same of a text; `path` is what messages call it.
CameraValues parse_camera_json(const std::string& text, const std::string& path,
                               const std::string& setting, double metres_per_unit);

/// Lens values among an image's metadata (standard EXR, Nuke and V-Ray keys). Empty where absent.
CameraValues camera_from_metadata(const ImageFile& file, double metres_per_unit);

/// The lens these values describe; 36 mm sensor width by default. Throws Error(usage) that names
/// every value that is missing or contradicts another.
Lens make_lens(const CameraValues& values, double metres_per_unit, LensModel model,
               double max_coc_px);

}  // namespace defray
