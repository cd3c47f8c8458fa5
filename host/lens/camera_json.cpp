#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "lens/camera.h"

namespace defray {
namespace {

using nlohmann::json;

json parse(const std::string& text, const std::string& path) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    const std::string what = error.what();  // begins with the library's own "[json...] "
    fail(ErrorKind::input, "{}: not valid JSON: {}", path, what.substr(what.find("] ") + 2));
  }
}

std::optional<double> number(const std::string& path, const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) return std::nullopt;
  if (!object[key].is_number()) fail(ErrorKind::input, "{}: '{}' is not a number", path, key);
  return object[key].get<double>();
}

/// The focus setting asked for, or the only one there is. No copy: the JSON library copies one call
/// deep a level, and a file may have more levels than the stack.
const json& choose_setting(const std::string& path, const json& root, const std::string& setting) {
  // A file without settings may state focus and aperture beside the focal length.
  if (!root.contains("focus_settings")) return root;
  const json& settings = root["focus_settings"];
  if (!settings.is_object()) fail(ErrorKind::input, "{}: 'focus_settings' is no object", path);
  std::vector<std::string> names;
  for (const auto& item : settings.items()) names.push_back(item.key());
  if (!setting.empty()) {
    if (settings.contains(setting)) return settings[setting];
    fail(ErrorKind::input, "{}: no focus setting '{}'.{} It has: {}", path, setting,
         did_you_mean(setting, names), join(names, " "));
  }
  if (names.size() > 1) {
    fail(ErrorKind::input, "{}: has several focus settings: {}; choose with {}", path,
         join(names, " "), field("focus_setting"));
  }
  static const json nothing = json::object();
  return names.empty() ? nothing : settings[names.front()];
}

std::optional<double> times(std::optional<double> value, double factor) {
  if (value) *value *= factor;
  return value;
}

}  // namespace

CameraValues parse_camera_json(const std::string& text, const std::string& path,
                               const std::string& setting, double metres_per_unit) {
  const json root = parse(text, path);
  if (!root.is_object()) fail(ErrorKind::input, "{}: not a JSON object", path);
  const json& focus = choose_setting(path, root, setting);
  CameraValues values;
  values.source = path;
  values.focal_length_mm = number(path, root, "focal_length_mm");
  values.sensor_width_mm = number(path, root, "sensor_width_mm");
  values.focus_distance_units = times(number(path, focus, "focus_distance_m"), 1 / metres_per_unit);
  // Renderers trace with the diameter; an f-number beside it is rounded or derived.
  values.aperture_diameter_mm = times(number(path, focus, "aperture_diameter_m"), 1000);
  if (!values.aperture_diameter_mm) values.fstop = number(path, focus, "f_stop");
  return values;
}

CameraValues read_camera_json(const std::string& path, const std::string& setting,
                              double metres_per_unit) {
  std::ifstream stream(path);
  if (!stream || !std::filesystem::is_regular_file(path)) {
    fail(ErrorKind::input, "{}: cannot open the camera file", path);
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_camera_json(text, path, setting, metres_per_unit);
}

}  // namespace defray
