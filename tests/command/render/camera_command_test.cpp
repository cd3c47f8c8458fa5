// defray render: the camera as people have it: sensors, fields of view, cut-outs, focus on a range.
#include <fstream>

#include "command/render/camera_fixture.h"

namespace defray::test::camera_command_test {
namespace {

using nlohmann::json;

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

TEST_F(Camera, AnUprightFrameWhoseWidthGetsTheSensorIsNoted) {
  const auto notes = [&](const std::string& arguments) {
    const std::string lens = " -o o.exr --focus 3 --focal-length 50 ";
    return report(arguments + lens)["notes"].dump();
  };
  const std::string note = "the frame is upright, its width has the sensor's ";
  const auto in = [&](const std::string& arguments) { return notes(arguments).find(note); };
  const std::string auto_is = " mm: with --sensor-fit auto, as Blender's Auto, it would have ";
  const std::string usual = notes("tall.exr --fstop 2");
  EXPECT_NE(usual.find(note + "36" + auto_is + "24 mm; horizontal says that it is so"),
            std::string::npos)
      << usual;
  const std::string stated = notes("tall.exr --fstop 2 --sensor-width 30");
  EXPECT_NE(stated.find(note + "30" + auto_is + "20 mm"), std::string::npos) << stated;
  EXPECT_NE(in("wide.exr --fstop 2 --full-size 48x96+0+0"), std::string::npos);
  for (const std::string told : {"--sensor-fit auto", "--sensor-fit horizontal", "--fov 40",
                                 "--sensor-height 24", "--pixel-scale 9000"}) {
    EXPECT_EQ(in("tall.exr --fstop 2 " + told), std::string::npos) << told;
  }
  EXPECT_EQ(in("tall.exr --aperture-diameter 0"), std::string::npos);
  EXPECT_EQ(in("tall.exr --fstop 2 --full-size 48x48+0+0"), std::string::npos);
  EXPECT_EQ(in("wide.exr --fstop 2"), std::string::npos);
  write_picture_file(folder_, "square.exr", {"R", "G", "B", "Z"}, {32, 32});
  EXPECT_EQ(in("square.exr --fstop 2"), std::string::npos);
  expect_ok(defray(folder_, "scene plate1 -o . --width 20 --height 30 --truth-samples 1"));
  EXPECT_EQ(in("pinhole.exr --camera camera.json --fstop 2"), std::string::npos) << "its own";
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
  expect_refused(in + "--focus-range 2,3:1,3,4:2", 2,
                 {"--focus-range changes over frames", "wide.exr has none"});
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
  // Places are the picture's, as any viewer shows them.
  const std::string at = " -o o.exr --focus-at 15,7 --fstop 1 --focal-length 50";
  EXPECT_EQ(report("part.exr --full-size 48x32+10+8" + at)["focus_distance_units"],
            report("part.exr" + at)["focus_distance_units"]);
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
  for (const std::string odd : {"4", "2,3,4", "2,3:1,4:2,smooth"}) {
    expect_refused(in + odd, 2,
                   {"--focus-range '" + odd + "': write its two ends as 2,4.5, or as 2,4.5:1"});
  }
  expect_refused(in + "2,3,3,4", 2, {"--focus-range: '2' has no frame"});
  expect_refused(in + "2,3:1,x,4:2", 2, {"--focus-range: 'x:2' cannot be read as a number"});
  expect_refused(in + "2,3 --focus 3", 2, {"give one of"});
}

}  // namespace
}  // namespace defray::test::camera_command_test
