#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/input_file.h"
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

/// A number that makes no sense as 0 or less.
std::optional<double> positive(const std::string& path, const json& object, const char* key) {
  const std::optional<double> value = number(path, object, key);
  if (value && !(*value > 0)) {
    fail(ErrorKind::input, "{}: '{}' is {}: it must be above 0", path, key, *value);
  }
  return value;
}

/// Of the focus: "inf", too, which JSON has no number for.
std::optional<double> distance(const std::string& path, const json& object, const char* key) {
  if (object.is_object() && object.contains(key) && object[key].is_string() &&
      lower_case(object[key].get<std::string>()) == "inf") {
    return std::numeric_limits<double>::infinity();
  }
  return positive(path, object, key);
}

/// The focus setting asked for, or the only one there is. No copy: the JSON library copies one call
/// deep a level, and a file may have more levels than the stack.
const json& choose_setting(const std::string& path, const json& root, const std::string& setting) {
  static const json none = json::object();
  const json& settings = root.contains("focus_settings") ? root["focus_settings"] : none;
  if (!settings.is_object()) fail(ErrorKind::input, "{}: 'focus_settings' is no object", path);
  std::vector<std::string> names;
  for (const auto& item : settings.items()) {
    names.push_back(item.key());
    if (item.value().is_object()) continue;
    fail(ErrorKind::input, "{}: focus setting '{}' is no object", path, item.key());
  }
  if (!setting.empty()) {
    if (settings.contains(setting)) return settings[setting];
    if (names.empty()) {
      fail(ErrorKind::input, "{}: no focus setting '{}': it has none; leave {} out", path, setting,
           field("focus_setting"));
    }
    fail(ErrorKind::input, "{}: no focus setting '{}'.{} It has: {}", path, setting,
         did_you_mean(setting, names), join(names, " "));
  }
  if (names.size() > 1) {
    fail(ErrorKind::input, "{}: has several focus settings: {}; choose with {}", path,
         join(names, " "), field("focus_setting"));
  }
  // A file without settings may state focus and aperture beside the focal length.
  return names.empty() ? root : settings[names.front()];
}

/// The known key that has the key's first word, without underscores and units: "fstop" and
/// "focusDistance" for f_stop and focus_distance_m.
std::string same_words(const std::string& key, const std::vector<std::string>& known) {
  const auto letters = [](const std::string& text) {
    std::string only;
    for (const char c : lower_case(text)) {
      if (c != '_') only += c;
    }
    return only;
  };
  for (const std::string& candidate : known) {
    if (letters(candidate).starts_with(letters(key))) return candidate;
  }
  return "";
}

/// What a camera.json may say of the camera, of each focus setting, and, for other programs,
/// besides.
const std::vector<std::string> camera_keys{"focal_length_mm", "sensor_width_mm", "sensor_height_mm",
                                           "fov_deg",         "sensor_fit",      "focus_settings",
                                           "from_m",          "look_at_m",       "up"};
const std::vector<std::string> focus_keys{"focus_distance_m", "aperture_diameter_m", "f_stop"};
const std::set<std::string> other_keys{"scene",
                                       "width",
                                       "height",
                                       "frame",
                                       "camera",
                                       "pixel_focal_px",
                                       "notes",
                                       "defray_options",
                                       "truth_noise_psnr_srgb_db",
                                       "blender",
                                       "truth_noise_psnr_linear_db"};

/// An iris is no part of a camera.json; other programs state one, 0 for a circle.
void note_blades(const std::string& path, const json& blades, std::vector<std::string>& notes) {
  if (!blades.is_number() || !(blades.get<double>() > 0)) return;
  notes.push_back(fmt::format("{}: key 'blades' is not used: {} {} is such an aperture", path,
                              field("blades"), blades.get<double>()));
}

/// Notes the keys of an object that are none of its own: those of another place, `there`, and those
/// of none.
void note_unknown_keys(const std::string& path, const json& object,
                       const std::vector<std::string>& own, const std::vector<std::string>& others,
                       const char* there, std::vector<std::string>& notes) {
  if (!object.is_object()) return;
  const auto has = [](const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  std::vector<std::string> known = own;
  known.insert(known.end(), others.begin(), others.end());
  for (const auto& item : object.items()) {
    const std::string& key = item.key();
    if (has(own, key) || other_keys.count(key) > 0) continue;
    if (key == "blades") {
      note_blades(path, item.value(), notes);
      continue;
    }
    if (has(others, key)) {
      notes.push_back(fmt::format("{}: key '{}' is ignored here: it belongs {}", path, key, there));
      continue;
    }
    std::string nearest = nearest_spelling(key, known);
    if (nearest.empty()) nearest = same_words(key, known);
    notes.push_back(
        fmt::format("{}: key '{}' is not known, and ignored{}", path, key,
                    nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
}

std::optional<SensorFit> sensor_fit(const std::string& path, const json& root) {
  if (!root.contains("sensor_fit")) return std::nullopt;
  const std::pair<const char*, SensorFit> words[] = {{"horizontal", SensorFit::horizontal},
                                                     {"vertical", SensorFit::vertical},
                                                     {"auto", SensorFit::longer}};
  const json& said = root["sensor_fit"];
  for (const auto& [word, fit] : words) {
    if (said.is_string() && lower_case(said.get<std::string>()) == word) return fit;
  }
  fail(ErrorKind::input, "{}: 'sensor_fit' is none of horizontal, vertical, auto", path);
}

/// Three numbers.
std::optional<std::array<double, 3>> point(const std::string& path, const json& root,
                                           const char* key, double factor) {
  if (!root.is_object() || !root.contains(key)) return std::nullopt;
  const json& values = root[key];
  std::array<double, 3> made{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!values.is_array() || values.size() != 3 || !values[i].is_number()) {
      fail(ErrorKind::input, "{}: '{}' is no list of three numbers", path, key);
    }
    made[i] = values[i].get<double>() * factor;
  }
  return made;
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
  values.source = values.sensor_source = path;
  values.focal_length_mm = positive(path, root, "focal_length_mm");
  values.sensor_width_mm = positive(path, root, "sensor_width_mm");
  values.sensor_height_mm = positive(path, root, "sensor_height_mm");
  values.fov_deg = positive(path, root, "fov_deg");
  if (values.fov_deg && !(*values.fov_deg < 180)) {
    fail(ErrorKind::input, "{}: 'fov_deg' is {}: it must be below 180", path, *values.fov_deg);
  }
  values.fit = sensor_fit(path, root);
  values.focus_distance_units =
      times(distance(path, focus, "focus_distance_m"), 1 / metres_per_unit);
  // Renderers trace with the diameter; an f-number beside it is rounded or derived.
  values.aperture_diameter_mm = times(number(path, focus, "aperture_diameter_m"), 1000);
  if (!values.aperture_diameter_mm) values.fstop = positive(path, focus, "f_stop");
  values.sought = {{"focal_length_mm", "focal_length_mm"},
                   {"focus_distance_units", "focus_distance_m"},
                   {"fstop", "f_stop or aperture_diameter_m"}};
  if (&focus == &root) {
    std::vector<std::string> all = camera_keys;
    all.insert(all.end(), focus_keys.begin(), focus_keys.end());
    note_unknown_keys(path, root, all, {}, "", values.notes);
  } else {
    note_unknown_keys(path, root, camera_keys, focus_keys, "into a focus setting", values.notes);
    note_unknown_keys(path, focus, focus_keys, camera_keys, "beside the focus settings",
                      values.notes);
  }
  return values;
}

std::optional<CameraPose> parse_camera_pose(const std::string& text, const std::string& path,
                                            double metres_per_unit) {
  const json root = parse(text, path);
  const auto from = point(path, root, "from_m", 1 / metres_per_unit);
  const auto look_at = point(path, root, "look_at_m", 1 / metres_per_unit);
  const auto up = point(path, root, "up", 1);
  if (!from && !look_at && !up) return std::nullopt;
  if (!from || !look_at) {
    fail(ErrorKind::input, "{}: has {} alone: a camera needs 'from_m' and 'look_at_m'", path,
         from      ? "'from_m'"
         : look_at ? "'look_at_m'"
                   : "'up'");
  }
  return CameraPose{*from, *look_at, up.value_or(CameraPose().up)};
}

CameraValues read_camera_json(const std::string& path, const std::string& setting,
                              double metres_per_unit) {
  return parse_camera_json(text_of(path), path, setting, metres_per_unit);
}

std::optional<CameraPose> read_camera_pose(const std::string& path, double metres_per_unit) {
  return parse_camera_pose(text_of(path), path, metres_per_unit);
}

}  // namespace defray
