#include "options/camera_file.h"

#include <utility>

#include "standard_streams.h"

namespace defray::cli {

CameraValues read_camera_file(const std::string& path, const std::string& focus_setting,
                              double metres_per_unit) {
  CameraValues values = read_camera_json(path, focus_setting, metres_per_unit);
  for (const std::string& note : std::exchange(values.notes, {})) {
    print_error("defray: note: " + note);
  }
  return values;
}

}  // namespace defray::cli
