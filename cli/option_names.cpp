#include "option_names.h"

#include <algorithm>
#include <map>

namespace defray::cli {

std::string option_of_field(const std::string& field) {
  static const std::map<std::string, std::string> others{
      {"aperture.image", "--aperture-image"},
      {"aperture_diameter_mm", "--aperture-diameter"},
      {"cells_per_side", "--rdb"},
      {"coc", "--coc-out"},
      {"confidence", "--confidence-out"},
      {"curvature", "--blade-curvature"},
      {"depth.kind", "--depth-kind"},
      {"far_units", "--far"},
      {"focal_length_mm", "--focal-length"},
      {"focus_distance_units", "--focus"},
      {"max_blur_px", "--max-blur"},
      {"max_coc_px", "--max-coc"},
      {"metres_per_unit", "--unit"},
      {"near_units", "--near"},
      {"output", "-o"},
      {"perceived_distance_m", "--perceived-distance"},
      {"perceived_scale", "--scale"},
      {"pixels_per_metre", "--pixel-scale"},
      {"rotation_deg", "--blade-rotation"},
      {"sensor_width_mm", "--sensor-width"}};
  if (const auto found = others.find(field); found != others.end()) return found->second;
  std::string name = field;
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::string message_of(const Error& error) {
  return with_field_names(error.marked(), option_of_field);
}

}  // namespace defray::cli
