// The camera's JSON files: what they say, and what is wrong with them.
#include <fstream>

#include "lens/camera.h"
#include "support.h"

namespace defray::test::camera_json_test {
namespace {

std::string write_text(const Folder& folder, const std::string& text) {
  const std::string path = folder / "camera.json";
  std::ofstream(path) << text;
  return path;
}

TEST(Camera, ReadsTheSharedShape) {
  const Folder folder;
  const std::string path = write_text(folder, R"({"focal_length_mm": 35, "sensor_width_mm": 24,
    "focus_settings": {"a": {"focus_distance_m": 3, "aperture_diameter_m": 0.02, "f_stop": 9},
                       "b": {"focus_distance_m": 4, "f_stop": 2}}})");
  const CameraValues a = read_camera_json(path, "a", 0.01);
  EXPECT_DOUBLE_EQ(*a.focal_length_mm, 35);
  EXPECT_DOUBLE_EQ(*a.sensor_width_mm, 24);
  EXPECT_DOUBLE_EQ(*a.focus_distance_units, 300);  // centimetres
  EXPECT_DOUBLE_EQ(*a.aperture_diameter_mm, 20);
  EXPECT_FALSE(a.fstop);
  EXPECT_DOUBLE_EQ(*read_camera_json(path, "b", 1).fstop, 2);
  expect_error(ErrorKind::input, {"a b", "focus_setting"}, [&] { read_camera_json(path, "", 1); });
  expect_error(ErrorKind::input, {"'c'", "a b"}, [&] { read_camera_json(path, "c", 1); });
  for (const std::string none : {"", R"(, "focus_settings": {})"}) {
    const std::string text = R"({"focal_length_mm": 35, "f_stop": 2)" + none + "}";
    expect_error(ErrorKind::input, {"c.json: no focus setting 'a': it has none; leave "},
                 [&] { parse_camera_json(text, "c.json", "a", 1); });
    EXPECT_DOUBLE_EQ(*parse_camera_json(text, "c.json", "", 1).fstop, 2);
  }
}

TEST(Camera, BadFiles) {
  const Folder folder;
  expect_error(ErrorKind::input, {"no such file"},
               [&] { read_camera_json(folder / "none.json", "", 1); });
  const std::vector<std::pair<const char*, const char*>> mistakes = {
      {"", "camera.json: not valid JSON: parse error at line 1"},
      {"{", "camera.json: not valid JSON: parse error at line 1, column 2"},
      {"[1]", "camera.json: not a JSON object"},
      {"3", "camera.json: not a JSON object"},
      {R"({"focal_length_mm": "x"})", "camera.json: 'focal_length_mm' is not a number"},
      {R"({"focal_length_mm": 0})", "camera.json: 'focal_length_mm' is 0: it must be above 0"},
      {R"({"sensor_width_mm": -1})", "camera.json: 'sensor_width_mm' is -1: it must be above 0"},
      {R"({"sensor_height_mm": -1})", "camera.json: 'sensor_height_mm' is -1"},
      {R"({"fov_deg": 180})", "camera.json: 'fov_deg' is 180: it must be below 180"},
      {R"({"fov_deg": -4})", "camera.json: 'fov_deg' is -4: it must be above 0"},
      {R"({"focus_distance_m": -3})", "camera.json: 'focus_distance_m' is -3"},
      {R"({"focus_distance_m": "far"})", "camera.json: 'focus_distance_m' is not a number"},
      {R"({"f_stop": 0})", "camera.json: 'f_stop' is 0: it must be above 0"},
      {R"({"focus_settings": {"a": 5}})", "camera.json: focus setting 'a' is no object"},
      {R"({"focus_settings": 3})", "camera.json: 'focus_settings' is no object"}};
  for (const auto& mistake : mistakes) {
    expect_error(ErrorKind::input, {mistake.second},
                 [&] { read_camera_json(write_text(folder, mistake.first), "", 1); });
  }
  expect_error(ErrorKind::input, {"is a folder"}, [&] { read_camera_json(folder.path(), "", 1); });
  const CameraValues half =
      read_camera_json(write_text(folder, R"({"focal_length_mm": 50, "f_stop": 2})"), "", 1);
  EXPECT_DOUBLE_EQ(*half.fstop, 2);
  expect_error(ErrorKind::usage, {"focus_distance_units", "camera.json"},
               [&] { make_lens(half, 1, LensModel::cg, 0); });
}

TEST(Camera, AFocusMayBeAtInfinity) {
  const CameraValues far = parse_camera_json(R"({"focus_distance_m": "Inf"})", "c.json", "", 0.01);
  EXPECT_TRUE(std::isinf(*far.focus_distance_units));
}

TEST(Camera, AJsonFileOfManyLevelsIsRead) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  for (const std::string key : {"focus_settings\": {\"a\": {\"b", "notes"}) {
    const std::string close = key == "notes" ? "}" : "}}}";
    const std::string text = "{\"focal_length_mm\": 50, \"" + key + "\": " + deep + close;
    EXPECT_EQ(parse_camera_json(text, "camera.json", "", 1).focal_length_mm, 50);
  }
}

}  // namespace
}  // namespace defray::test::camera_json_test
