// Depth conventions, the camera's sources, and frame ranges.
#include "depth.h"

#include <cmath>
#include <fstream>
#include <limits>

#include "camera.h"
#include "sequence.h"
#include "support.h"

namespace defray::test {
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
  expect_error(3, {"z.exr", "depth 0", "(3, 0)", "--background"}, [&] {
    converted({2, 7, 3, 0, 4}, settings);
  });
  expect_error(3, {"depth -1"}, [&] { converted({2, 7, 3, -1, 4}, settings); });
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

TEST(Depth, SettingsThatContradictEachOther) {
  DepthSettings settings;
  settings.invert = true;
  expect_error(2, {"--invert", "normalized"}, [&] { validate(settings); });
  settings = {};
  settings.near_units = 1;
  expect_error(2, {"--near", "normalized"}, [&] { validate(settings); });
  settings.kind = DepthKind::normalized;
  expect_error(2, {"--near < --far"}, [&] { validate(settings); });
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
  expect_error(3, {"a b", "--focus-setting"}, [&] { read_camera_json(path, "", 1); });
  expect_error(3, {"'c'", "a b"}, [&] { read_camera_json(path, "c", 1); });
}

TEST(Camera, BadFiles) {
  const Folder folder;
  expect_error(3, {"cannot open"}, [&] { read_camera_json(folder / "none.json", "", 1); });
  for (const char* text :
       {"", "{", "[1]", "3", R"({"focal_length_mm": "x"})", R"({"focus_settings": 3})"}) {
    expect_error(3, {"camera.json"}, [&] { read_camera_json(write_text(folder, text), "", 1); });
  }
  expect_error(3, {"cannot open"}, [&] { read_camera_json(folder.path(), "", 1); });
  const CameraValues half =
      read_camera_json(write_text(folder, R"({"focal_length_mm": 50, "f_stop": 2})"), "", 1);
  EXPECT_DOUBLE_EQ(*half.fstop, 2);
  expect_error(2, {"--focus", "camera.json"}, [&] { make_lens(half, 1, LensModel::cg, 0); });
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
  expect_error(2, {"--focus", "--focal-length", "--fstop"},
               [] { make_lens({}, 1, LensModel::cg, 0); });
  CameraValues both;
  both.focal_length_mm = 50;
  both.fstop = 2;
  both.aperture_diameter_mm = 20;
  both.focus_distance_units = 3;
  expect_error(2, {"one of them"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  both.aperture_diameter_mm.reset();
  for (const double f : {0.0, -2.0, double{NAN}}) {
    both.fstop = f;
    expect_error(2, {"f-number"}, [&] { make_lens(both, 1, LensModel::cg, 0); });
  }
}

TEST(Sequence, Ranges) {
  EXPECT_EQ(parse_frames("1-4"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("1-10x3"), (std::vector<int>{1, 4, 7, 10}));
  EXPECT_EQ(parse_frames("7,3,9-10"), (std::vector<int>{7, 3, 9, 10}));
  EXPECT_EQ(parse_frames("-3--1"), (std::vector<int>{-3, -2, -1}));
  EXPECT_EQ(parse_frames("9-1x4"), (std::vector<int>{9, 5, 1}));
  EXPECT_EQ(parse_frames("1-10x-4"), (std::vector<int>{10, 6, 2}));
  EXPECT_EQ(parse_frames("1-6y2"), (std::vector<int>{2, 4, 6}));
  EXPECT_EQ(parse_frames("1-999999999x500000000"), (std::vector<int>{1, 500000001}));
  EXPECT_EQ(parse_frames("1,1,3-1"), (std::vector<int>{1, 3, 2}));
  for (const char* bad : {"", "a", "1-", "-", "1..3", "1-3x0", "1,,2", "1-3;4", "1e3"}) {
    expect_error(2, {"--frames"}, [bad] { parse_frames(bad); });
  }
  for (const char* many : {"1-999999999", "1-999999999y1", "1-600000,600001-1200000"}) {
    expect_error(2, {"at most"}, [many] { parse_frames(many); });
  }
  expect_error(2, {"not a frame range"}, [] { parse_frames("1-2000000000"); });
  expect_error(2, {"no frame"}, [] { parse_frames("1-1y2"); });
}

TEST(Sequence, Patterns) {
  EXPECT_EQ(frame_path("shot.####.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.##.exr", 7), "shot.07.exr");
  EXPECT_EQ(frame_path("shot.#.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.%04d.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.@@@.exr", 7), "shot.007.exr");
  EXPECT_EQ(frame_path("shot.####.exr", 12345), "shot.12345.exr");
  EXPECT_EQ(frame_path("shot.exr", 7), "shot.exr");
  EXPECT_EQ(frame_path("a%n.%d.exr", 7), "a%n.7.exr");
  EXPECT_EQ(frame_path("shot.%3d.exr", 7), "shot.  7.exr");
  EXPECT_EQ(frame_path("shot.####.exr", -7), "shot.-007.exr");
  EXPECT_TRUE(has_frame_pattern("a.####.exr"));
  EXPECT_FALSE(has_frame_pattern("a.exr"));
  const Folder folder;
  for (const char* name : {"s.0003.exr", "s.0001.exr", "s.001.exr", "t.0002.exr"}) {
    std::ofstream(folder / name) << "x";
  }
  EXPECT_EQ(find_frames(folder / "s.####.exr"), (std::vector<int>{1, 3}));
  expect_error(3, {"no file matches"}, [&] { find_frames(folder / "u.####.exr"); });
  EXPECT_EQ(find_frames(folder / "s.###.exr"), (std::vector<int>{1}));
  for (const std::string wide : {"%0999d", "%099999999999999999999d"}) {
    expect_error(2, {"too many digits"}, [&] { frame_path(wide + ".exr", 1); });
  }
  const std::string hashes(1000000, '#');  // std::regex would run out of stack
  expect_error(2, {"too many digits"}, [&] { has_frame_pattern(hashes); });
  expect_error(2, {"2 frame patterns"}, [] { frame_path("s_%04d.####.exr", 1); });
}

TEST(Sequence, FoldersAndLiteralNamesAreNoPatterns) {
  const Folder folder;
  for (const char* name : {"me@home", "job_%d#2"}) {
    std::filesystem::create_directory(folder / name);
    const std::string inside = folder / name + "/";
    std::ofstream(inside + "s.0004.exr") << "x";
    std::ofstream(inside + "a@2x.exr") << "x";
    EXPECT_FALSE(has_frame_pattern(inside + "s.0004.exr"));
    EXPECT_FALSE(has_frame_pattern(inside + "a@2x.exr")) << "this very file exists";
    EXPECT_EQ(find_frames(inside + "s.####.exr"), (std::vector<int>{4}));
    EXPECT_EQ(frame_path(inside + "s.####.exr", 7), inside + "s.0007.exr");
  }
}

}  // namespace
}  // namespace defray::test
