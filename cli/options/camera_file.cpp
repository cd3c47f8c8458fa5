#include "options/camera_file.h"

#include <utility>

#include "options/option_table.h"
#include "standard_streams.h"

namespace defray::cli {

std::string beside_render(const std::string& note) {
  return with_field_names(
      note, [](const std::string& field) { return "render's " + option_of_field(field); });
}

CameraValues read_camera_file(const std::string& path, const std::string& focus_setting,
                              double metres_per_unit) {
  CameraValues values = read_camera_json(path, focus_setting, metres_per_unit);
  for (const std::string& note : std::exchange(values.notes, {})) {
    print_error("defray: note: " + beside_render(note));
  }
  return values;
}

}  // namespace defray::cli
