// defray render: the camera as people have it: sensors, fields of view, cut-outs, lenses that
// change, focus on a place or a range.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command/program.h"

namespace defray::test::camera_command_test {
namespace {

using nlohmann::json;

class Camera : public testing::Test {
 protected:
  Camera() {
    write_picture_file(folder_, "wide.exr", {"R", "G", "B", "Z"}, {48, 32});
    write_picture_file(folder_, "tall.exr", {"R", "G", "B", "Z"}, {32, 48});
  }
  json report(const std::string& arguments) const {
    const Result result = defray(folder_, "render " + arguments + " --json");
    expect_ok(result);
    return json::parse(result.out.substr(0, result.out.find('\n')));
  }
  double sensor(const std::string& arguments) const {
    return report(arguments + " -o o.exr --focus 3 --fstop 2 --focal-length 50")["sensor_width_mm"];
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, "render " + arguments), code, words, arguments);
  }
  Folder folder_;
};

TEST_F(Camera, ASensorSpansTheSideThatItsFitSays) {
  EXPECT_DOUBLE_EQ(sensor("tall.exr --sensor-width 36"), 36);
  EXPECT_DOUBLE_EQ(sensor("tall.exr --sensor-width 36 --sensor-fit auto"), 24);
  EXPECT_DOUBLE_EQ(sensor("wide.exr --sensor-width 36 --sensor-fit auto"), 36);
  EXPECT_DOUBLE_EQ(sensor("wide.exr --sensor-height 24"), 36);
  EXPECT_DOUBLE_EQ(sensor("tall.exr --sensor-height 24 --sensor-fit vertical"), 16);
  EXPECT_DOUBLE_EQ(sensor("tall.exr --sensor-fit horizontal"), 36);
  const double across = 100 * std::tan(0.5);  // of 1 radian, 50 mm
  EXPECT_NEAR(sensor("wide.exr --fov 57.29577951308232"), across, 1e-9);
  EXPECT_NEAR(sensor("wide.exr --fov 57.29577951308232 --sensor-fit vertical"), across * 1.5, 1e-9);
  EXPECT_NEAR(sensor("tall.exr --fov 57.29577951308232 --sensor-fit auto"), across / 1.5, 1e-9);
}

TEST_F(Camera, SensorsThatContradictEachOtherAreRefused) {
  const std::string in = "wide.exr -o o.exr --focus 3 --fstop 2 --focal-length 50 ";
  expect_refused(in + "--fov 40 --sensor-width 36", 2, {"--sensor-width and --fov say the same"});
  expect_refused(in + "--fov 180", 2, {"--fov is 180 degrees", "below 180"});
  expect_refused(in + "--sensor-width 36 --sensor-height 24", 2,
                 {"--sensor-width and --sensor-height say the same"});
  expect_refused(in + "--sensor-fit vertical", 2, {"--sensor-fit vertical needs --sensor-height"});
  expect_refused(in + "--sensor-fit wide", 2, {"'wide'", "auto horizontal vertical"});
  for (const std::string fit : {"auto", "horizontal"}) {
    expect_refused(
        in + "--sensor-height 24 --sensor-fit " + fit, 2,
        {"--sensor-height goes with --sensor-fit vertical, found " + fit, "give --sensor-width"});
    expect_refused(in + "--sensor-width 36 --sensor-height 24 --sensor-fit " + fit, 2,
                   {"--sensor-height goes with --sensor-fit vertical"});
  }
}

TEST_F(Camera, SensorsOfACameraFile) {
  const auto camera = [&](const std::string& sensor) {
    std::ofstream(folder_ / "camera.json")
        << R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2, )" << sensor << "}";
    return std::string("tall.exr -o o.exr --camera camera.json ");
  };
  const std::string doubled = camera(R"("sensor_width_mm": 36, "fov_deg": 40)");
  expect_refused(doubled, 3,
                 {"camera.json: keys 'sensor_width_mm' and 'fov_deg' say the same thing"});
  EXPECT_DOUBLE_EQ(report(doubled + "--sensor-width 30")["sensor_width_mm"], 30);
  expect_refused(doubled + "--sensor-width 30 --fov 40", 2, {"--sensor-width and --fov say"});
  EXPECT_DOUBLE_EQ(report(camera(R"("sensor_width_mm": 36, "sensor_height_mm": 24,
                                     "sensor_fit": "auto")"))["sensor_width_mm"],
                   24);
  // As Blender spells it.
  for (const auto& [fit, across] : {std::pair{"AUTO", 24.0}, {"HORIZONTAL", 36.0}}) {
    EXPECT_DOUBLE_EQ(report(camera(fmt::format(R"("sensor_width_mm": 36, "sensor_fit": "{}")",
                                               fit)))["sensor_width_mm"],
                     across);
  }
  EXPECT_DOUBLE_EQ(
      report(camera(R"("sensor_height_mm": 24, "sensor_fit": "VERTICAL")"))["sensor_width_mm"], 16);
  expect_refused(camera(R"("sensor_height_mm": 24, "sensor_fit": "AUTO")"), 2,
                 {"camera.json: --sensor-height goes with --sensor-fit vertical, found auto"});
  EXPECT_DOUBLE_EQ(report(camera(R"("sensor_width_mm": 36, "sensor_fit": "AUTO")") +
                          "--sensor-height 24")["sensor_width_mm"],
                   16);
}

TEST_F(Camera, WhatChangesNeedsFrames) {
  const std::string in = "wide.exr -o o.exr --fstop 2 --focal-length 50 ";
  expect_refused(in + "--focus-range 2:1,3:2", 2,
                 {"--focus-range '2:1,3:2': takes no frames", "write them as 2,4.5"});
  expect_refused(in + "--camera camera.####.json", 2,
                 {"--camera camera.####.json: is one a frame", "wide.exr is one picture",
                  "put #### in its name"});
}

TEST_F(Camera, ACutOutIsBlurredAsTheWholeFrame) {
  write_picture_file(folder_, "part.exr", {"R", "G", "B", "Z"}, {20, 12});
  const std::string options = " -o o.exr --focus 3 --fstop 1 --focal-length 50";
  const json cropped = report("part.exr --full-size 48x32+10+8" + options);
  EXPECT_EQ(cropped["display_window"], (json{-10, -8, 48, 32}));
  const json alone = report("part.exr" + options);
  // The CoC goes with the width of the frame that the sensor spans.
  EXPECT_NEAR(cropped["farthest_coc_px"].get<double>() / alone["farthest_coc_px"].get<double>(),
              48.0 / 20, 0.05);
  EXPECT_EQ(ImageFile::read(folder_ / "o.exr").parts()[0].display, (Window{0, 0, 20, 12}));
  expect_refused("part.exr --full-size 48x32+30+8" + options, 3,
                 {"part.exr: has 20x12 pixels, which do not fit into --full-size 48x32+30+8"});
  for (const std::string bad : {"48x32", "48x32+1", "0x32+0+0", "48x32-1+0", "ax2+0+0"}) {
    expect_refused("part.exr --full-size " + bad + options, 2,
                   {"--full-size '" + bad + "'", "3840x2160+100+50"});
  }
}

/// Distances along rays know the pixel's place in the whole frame.
TEST_F(Camera, ACutOutsRaysAreThoseOfTheWholeFrame) {
  write_picture_file(folder_, "part.exr", {"R", "G", "B", "Z"}, {20, 12});
  const std::string options =
      "part.exr -o o.exr --depth-kind distance --focus 3 --fstop 1 --focal-length 20 --full-size ";
  EXPECT_NE(report(options + "48x32+0+0")["farthest_units"],
            report(options + "48x32+14+10")["farthest_units"]);
}

class Sequences : public Camera {
 protected:
  Sequences() {
    for (int i = 1; i <= 3; ++i) {
      write_picture_file(folder_, fmt::format("s.000{}.exr", i), {"R", "G", "B", "Z"});
    }
  }
  std::vector<json> frames(const std::string& options) const {
    const Result result = defray(folder_, "render s.####.exr -o o.####.exr --json " + options);
    expect_ok(result);
    std::istringstream lines(result.out);
    std::vector<json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(json::parse(line));
    EXPECT_EQ(all.size(), 3u);
    all.resize(3);
    return all;
  }
};

TEST_F(Sequences, LensNumbersChange) {
  const auto linear =
      frames("--focus 3:1,2:3 --fstop 2 --focal-length 50:2,60:3 --sensor-width 36:1,24:3");
  EXPECT_DOUBLE_EQ(linear[0]["focus_distance_units"], 3);
  EXPECT_DOUBLE_EQ(linear[1]["focus_distance_units"], 2.5);
  EXPECT_DOUBLE_EQ(linear[2]["focus_distance_units"], 2);
  EXPECT_DOUBLE_EQ(linear[0]["focal_length_mm"], 50);
  EXPECT_DOUBLE_EQ(linear[2]["focal_length_mm"], 60);
  EXPECT_DOUBLE_EQ(linear[1]["sensor_width_mm"], 30);
  const auto smooth = frames("--focus 3:1,2:5,smooth --fstop 2:1,4:3 --focal-length 50");
  EXPECT_DOUBLE_EQ(smooth[1]["focus_distance_units"], 3 - 0.15625);
  EXPECT_DOUBLE_EQ(smooth[1]["aperture_diameter_mm"], 50.0 / 3);
  expect_ok(defray(folder_,
                   "render s.0002.exr -o b.exr --focus 2.5 --fstop 2 --focal-length 50 "
                   "--sensor-width 30"));
  frames("--focus 3:1,2:3 --fstop 2 --focal-length 50 --sensor-width 36:1,24:3");
  EXPECT_EQ(file_hash(folder_ / "o.0002.exr"), file_hash(folder_ / "b.exr"));
}

TEST_F(Sequences, PerceivedSizesChange) {
  const std::string lens = "--focus 2.5 --fstop 2 --focal-length 50 ";
  const double aperture = frames(lens)[0]["aperture_diameter_mm"];
  const auto scaled = frames(lens + "--scale 0.5:1,0.25:3");
  EXPECT_DOUBLE_EQ(scaled[0]["aperture_diameter_mm"], aperture / 0.5);
  EXPECT_DOUBLE_EQ(scaled[1]["aperture_diameter_mm"], aperture / 0.375);
  const auto near = frames(lens + "--perceived-distance 1:1,2:3");
  EXPECT_DOUBLE_EQ(near[0]["aperture_diameter_mm"], aperture * 2.5);
  EXPECT_DOUBLE_EQ(near[2]["aperture_diameter_mm"], aperture * 2.5 / 2);
}

TEST_F(Sequences, CurvesAreReadStrictly) {
  const auto refused = [&](const std::string& focus, const std::string& words) {
    expect_refused("s.####.exr -o o.####.exr --fstop 2 --focal-length 50 --focus " + focus, 2,
                   {"--focus", words});
  };
  refused("3:1,2", "'2' has no frame");
  refused("3,smooth", "'3' has no frame");
  refused("3:a", "'3:a' has no frame number");
  refused("x", "'x' cannot be read as a number; write a number, or 3:1,2.2:24");
  refused("3:1,4:1", "has a frame twice");
  refused("inf:1,3:2", "'inf:1' cannot be animated");
  expect_refused("wide.exr -o o.exr --focus 3:1,2:9 --fstop 2 --focal-length 50", 2,
                 {"--focus changes over frames, the input wide.exr has none"});
  // The third frame's lens, before the first is rendered.
  expect_refused("s.####.exr -o o.####.exr --fstop 2 --focal-length 50 --focus 3:1,0:3", 2,
                 {"focus distance is 0"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o.0001.exr"));
}

TEST_F(Sequences, ACameraFileAFrame) {
  for (int i = 1; i <= 3; ++i) {
    std::ofstream(folder_ / fmt::format("camera.000{}.json", i))
        << R"({"focal_length_mm": 50, "f_stop": 2, "focus_distance_m": )" << i + 1 << "}";
  }
  const auto all = frames("--camera camera.####.json");
  for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(all[i]["focus_distance_units"], i + 2);
  std::filesystem::remove(folder_ / "camera.0002.json");
  const Result result = defray(folder_,
                               "render s.####.exr -o o.####.exr --camera camera.####.json "
                               "--skip-bad-frames");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("camera.0002.json: cannot open"), std::string::npos) << result.err;
}

TEST_F(Sequences, FocusOnAPlace) {
  const std::string optics = " --fstop 2 --focal-length 50 ";
  for (int i = 1; i <= 3; ++i) {
    Plane z(1536, 9.0f);
    for (int y = 8; y < 13; ++y) {
      for (int x = 18; x < 23; ++x) z[static_cast<std::size_t>(y * 48 + x)] = 2.0f + 0.5f * i;
    }
    z[10 * 48 + 20] = 1;  // a speck
    z[11 * 48 + 20] = std::numeric_limits<float>::infinity();
    const Plane grey(1536, 0.5f);
    ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, z}, 48, 32,
                           Sample::single_float)
        .write(folder_ / fmt::format("s.000{}.exr", i));
  }
  const auto each = frames("--focus-at 20,10" + optics);
  const auto first = frames("--focus-at 20,10 --focus-frame 2" + optics);
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(each[i]["focus_distance_units"], 2.5 + 0.5 * i);
    EXPECT_DOUBLE_EQ(first[i]["focus_distance_units"], 3);
  }
  // The patch is as wide on each side: three columns of five, and rows, decide.
  for (const auto& [place, focus] : {std::pair{"16,10", 9.0},
                                     {"17,10", 9.0},
                                     {"18,10", 2.5},
                                     {"22,10", 2.5},
                                     {"23,10", 9.0},
                                     {"20,8", 2.5},
                                     {"20,7", 9.0},
                                     {"20,12", 2.5},
                                     {"20,13", 9.0}}) {
    const Result result = defray(
        folder_, std::string("render s.0001.exr -o o.exr --json --focus-at ") + place + optics);
    expect_ok(result);
    EXPECT_EQ(json::parse(result.out)["focus_distance_units"], focus) << place;
  }
  expect_refused("s.0001.exr -o o.exr --focus-at 48,10" + optics, 2,
                 {"--focus-at 48,10: s.0001.exr has pixels from 0,0 to 47,31"});
  expect_refused("s.0001.exr -o o.exr --focus-at 4" + optics, 2, {"--focus-at '4'", "640,360"});
  expect_refused("s.0001.exr -o o.exr --focus-at 4,4 --focus 3" + optics, 2,
                 {"give one of --focus, --focus-at, --focus-range"});
  expect_refused("s.0001.exr -o o.exr --focus-frame 2 --focus 3" + optics, 2,
                 {"--focus-frame needs a pattern"});
  expect_refused("s.####.exr -o o.####.exr --focus-frame 2 --focus 3" + optics, 2,
                 {"--focus-frame goes with --focus-at"});
  const Plane nothing(1536, 1e10f), grey(1536, 0.5f);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, nothing}, 48, 32,
                         Sample::single_float)
      .write(folder_ / "sky.exr");
  expect_refused("sky.exr -o o.exr --focus-at 4,4" + optics, 3,
                 {"sky.exr: --focus-at 4,4 is background"});
}

TEST_F(Camera, ARangeIsKeptSharp) {
  Plane z;
  for (int i = 0; i < 1536; ++i) z.push_back(1 + static_cast<float>(i % 48) / 6);  // 1 to 8.83
  const Plane grey(1536, 0.5f);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, z}, 48, 32, Sample::single_float)
      .write(folder_ / "ramp.exr");
  const auto coc = [&](const std::string& focus) {
    expect_ok(defray(folder_,
                     "render ramp.exr -o o.exr --coc-out coc.exr --fstop 1 "
                     "--focal-length 50 " +
                         focus));
    return ImageFile::read(folder_ / "coc.exr").plane(0, 0);
  };
  const Plane range = coc("--focus-range 2,4.5"), near = coc("--focus 2"), far = coc("--focus 4.5");
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_EQ(range[i], z[i] < 2 ? near[i] : z[i] > 4.5f ? far[i] : 0) << z[i];
  }
  EXPECT_EQ(coc("--focus-range 3,3"), coc("--focus 3"));
  EXPECT_EQ(coc("--focus-range 2,inf")[47], 0);
  const std::string in = "ramp.exr -o o.exr --fstop 1 --focal-length 50 --focus-range ";
  expect_refused(in + "4,3", 2, {"--focus-range goes from 4 to 3"});
  expect_refused(in + "4", 2, {"--focus-range '4': write its two ends"});
  expect_refused(in + "2,3 --focus 3", 2, {"give one of"});
}

}  // namespace
}  // namespace defray::test::camera_command_test
