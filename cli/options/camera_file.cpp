#include "options/camera_file.h"

#include <utility>

#include "options/option_table.h"
#include "standard_streams.h"

namespace defray::cli {

CameraValues read_camera_file(const std::string& path, const std::string& focus_setting,
                              double metres_per_unit) {
  CameraValues values = read_camera_json(path, focus_setting, metres_per_unit);
  for (const std::string& note : std::exchange(values.notes, {})) {
    // What these commands have no option for.
    const std::string said = with_field_names(
        note, [](const std::string& field) { return "render's " + option_of_field(field); });
    print_error("defray: note: " + said);
  }
  return values;
}

}  // namespace defray::cli
