// Depth conventions, and the camera's sources.
#include "lens/depth.h"

#include <cmath>
#include <fstream>
#include <limits>

#include "lens/camera.h"
#include "support.h"

namespace defray::test::depth_test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
const Window window{0, 0, 5, 1};

Plane converted(Plane depth, const DepthSettings& settings, DepthReport* report = nullptr,
                const Window& data = window, const Window& display = window) {
  const DepthReport r = convert_depth(depth, settings, data, display, 100, "z.exr");
  if (report) *report = r;
  return depth;
}

TEST(Depth, RecognisesBackgrounds) {
  DepthReport report;
  const Plane z = converted({2, 1e10f, 65504, 0, -1}, {}, &report);
  EXPECT_EQ(z, (Plane{2, inf, inf, inf, inf}));
  EXPECT_EQ(report.background, 4u);
  EXPECT_EQ(report.nearest_units, 2);
  EXPECT_EQ(report.farthest_units, 2);
  EXPECT_EQ(converted({inf, 3, 4, 5, 6}, {})[0], inf);
}

TEST(Depth, CountsNan) {
  DepthReport report;
  converted({NAN, 3, 4, 5, 6}, {}, &report);
  EXPECT_EQ(report.not_a_number, 1u);
  EXPECT_EQ(report.background, 1u);
}

TEST(Depth, AnExplicitBackgroundIsTheOnlyOne) {
  DepthSettings settings;
  settings.background = 7;
  EXPECT_EQ(converted({2, 7, 65504, 3, 4}, settings), (Plane{2, inf, 65504, 3, 4}));
  expect_error(ErrorKind::input, {"z.exr", "depth 0", "(3, 0)", "background"}, [&] {
    converted({2, 7, 3, 0, 4}, settings);
  });
  expect_error(ErrorKind::input, {"depth -1"}, [&] { converted({2, 7, 3, -1, 4}, settings); });
}

TEST(Depth, NothingButBackground) {
  DepthReport report;
  converted({0, 0, 0, 0, 0}, {}, &report);
  EXPECT_EQ(report.background, 5u);
  EXPECT_EQ(report.nearest_units, 0);
}

TEST(Depth, Inverse) {
  DepthSettings settings;
  settings.kind = DepthKind::inverse;
  EXPECT_EQ(converted({0.5f, 2, 0, 4, 1}, settings), (Plane{2, 0.5f, inf, 0.25f, 1}));
}

TEST(Depth, Normalized) {
  DepthSettings settings;
  settings.kind = DepthKind::normalized;
  settings.near_units = 2;
  settings.far_units = 10;
  EXPECT_EQ(converted({0, 0.25f, 1, 0.5f, inf}, settings), (Plane{2, 4, 10, 6, inf}));
  settings.invert = true;
  EXPECT_EQ(converted({0, 0.25f, 1, 0.5f, 0.5f}, settings), (Plane{10, 8, 2, 6, 6}));
}

TEST(Depth, DistanceAlongTheRayKnowsThePixelsPlaceInTheDisplayWindow) {
  DepthSettings settings;
  settings.kind = DepthKind::distance;
  // A plane at z = 3 seen as distances, in a data window away from the display window's corner.
  const Window data{70, 10, 5, 1}, display{0, 0, 100, 60};
  Plane distance;
  for (int x = 70; x < 75; ++x) {
    distance.push_back(static_cast<float>(3 * std::hypot(100, x + 0.5 - 50, 10.5 - 30) / 100));
  }
  for (const float z : converted(distance, settings, nullptr, data, display)) {
    EXPECT_NEAR(z, 3, 1e-6);
  }
}

TEST(Depth, DistanceKnowsWhereTheDisplayWindowBegins) {
  DepthSettings settings;
  settings.kind = DepthKind::distance;
  const Window data{35, -22, 4, 3}, display{30, -20, 21, 11};
  Plane distance;
  for (int y = -22; y < -19; ++y) {
    for (int x = 35; x < 39; ++x) {
      const double right = x + 0.5 - 40.5, down = y + 0.5 + 14.5;
      distance.push_back(static_cast<float>(3 * std::hypot(100, right, down) / 100));
    }
  }
  for (const float z : converted(distance, settings, nullptr, data, display)) {
    EXPECT_NEAR(z, 3, 1e-6);
  }
}

TEST(Depth, BackgroundsBeginWhereTheyAreSaidTo) {
  const auto before = [](float v) { return std::nextafter(v, 0.0f); };
  EXPECT_EQ(converted({1e9f, before(1e9f), before(65504), 65505, 1e-40f}, {}),
            (Plane{inf, before(1e9f), before(65504), 65505, 1e-40f}));
  DepthSettings inverse;
  inverse.kind = DepthKind::inverse;
  DepthReport report;
  // 1/z of a denormal is farther than floats go.
  EXPECT_EQ(converted({1e-40f, -1, 1e-30f, 4, 2}, inverse, &report),
            (Plane{inf, inf, 1e30f, 0.25f, 0.5f}));
  EXPECT_EQ(report.background, 2u);
  EXPECT_EQ(report.nearest_units, 0.25);
  EXPECT_NEAR(report.farthest_units, 1e30, 1e24);
}

TEST(Depth, NormalizedOutsideItsRangeIsCounted) {
  DepthSettings settings;
  settings.kind = DepthKind::normalized;
  settings.near_units = 2;
  settings.far_units = 10;
  DepthReport report;
  converted({0, 1, -0.125f, 1.125f, inf}, settings, &report);
  EXPECT_EQ(report.outside_range, 2u);
  EXPECT_EQ(report.background, 1u);
  EXPECT_EQ(report.nearest_units, 1);
  EXPECT_EQ(report.farthest_units, 11);
  DepthReport planar;
  converted({0.5f, 2, 3, 4, 5}, {}, &planar);
  EXPECT_EQ(planar.outside_range, 0u);
}

TEST(Depth, SettingsThatContradictEachOther) {
  DepthSettings settings;
  settings.invert = true;
  expect_error(ErrorKind::usage, {"invert", "normalized"}, [&] { validate(settings); });
  settings = {};
  settings.near_units = 1;
  expect_error(ErrorKind::usage, {"near_units", "normalized"}, [&] { validate(settings); });
  settings.kind = DepthKind::normalized;
  for (const auto& [near, far] : {std::pair{1.0, 0.0}, {0.0, 3.0}, {2.0, 2.0}, {1.0, HUGE_VAL}}) {
    settings.near_units = near;
    settings.far_units = far;
    expect_error(ErrorKind::usage, {"near_units < far_units"}, [&] { validate(settings); });
  }
  settings = {};
  settings.far_units = 3;
  expect_error(ErrorKind::usage, {"far_units", "normalized"}, [&] { validate(settings); });
}

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
}

TEST(Camera, BadFiles) {
  const Folder folder;
  expect_error(ErrorKind::input, {"cannot open"},
               [&] { read_camera_json(folder / "none.json", "", 1); });
  const std::vector<std::pair<const char*, const char*>> mistakes = {
      {"", "camera.json: not valid JSON: parse error at line 1"},
      {"{", "camera.json: not valid JSON: parse error at line 1, column 2"},
      {"[1]", "camera.json: not a JSON object"},
      {"3", "camera.json: not a JSON object"},
      {R"({"focal_length_mm": "x"})", "camera.json: 'focal_length_mm' is not a number"},
      {R"({"focus_settings": 3})", "camera.json: 'focus_settings' is no object"}};
  for (const auto& mistake : mistakes) {
    expect_error(ErrorKind::input, {mistake.second},
                 [&] { read_camera_json(write_text(folder, mistake.first), "", 1); });
  }
  expect_error(ErrorKind::input, {"cannot open"}, [&] { read_camera_json(folder.path(), "", 1); });
  const CameraValues half =
      read_camera_json(write_text(folder, R"({"focal_length_mm": 50, "f_stop": 2})"), "", 1);
  EXPECT_DOUBLE_EQ(*half.fstop, 2);
  expect_error(ErrorKind::usage, {"focus_distance_units", "camera.json"},
               [&] { make_lens(half, 1, LensModel::cg, 0); });
}

TEST(Camera, ExplicitValuesWin) {
  CameraValues file, typed;
  file.focal_length_mm = 50;
  file.aperture_diameter_mm = 20;
  file.focus_distance_units = 3;
  typed.fstop = 4;
  const Lens lens = make_lens(file.overridden_by(typed), 1, LensModel::cg, 0);
  EXPECT_DOUBLE_EQ(lens.aperture_diameter_mm, 12.5);
  EXPECT_DOUBLE_EQ(lens.focus_distance_units, 3);
  EXPECT_DOUBLE_EQ(lens.sensor_width_mm, 36);
}

TEST(Camera, SaysWhatIsMissing) {
  expect_error(ErrorKind::usage, {"focus_distance_units", "focal_length_mm", "fstop"},
               [] { make_lens({}, 1, LensModel::cg, 0); });
  CameraValues both;
  both.focal_length_mm = 50;
  both.fstop = 2;
  both.aperture_diameter_mm = 20;
  both.focus_distance_units = 3;
  expect_error(ErrorKind::usage, {"one of them"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  both.aperture_diameter_mm.reset();
  for (const double f : {0.0, -2.0, double{NAN}}) {
    both.fstop = f;
    expect_error(ErrorKind::usage, {"f-number"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  }
}

TEST(Camera, AJsonFileOfManyLevelsIsRead) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  for (const std::string key : {"focus_settings\": {\"a", "notes"}) {
    const std::string close = key == "notes" ? "}" : "}}";
    const std::string text = "{\"focal_length_mm\": 50, \"" + key + "\": " + deep + close;
    EXPECT_EQ(parse_camera_json(text, "camera.json", "", 1).focal_length_mm, 50);
  }
}

}  // namespace
}  // namespace defray::test::depth_test
