// defray render --camera from-metadata: the lens that renderers write into files.
#include <OpenImageIO/imagebuf.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::metadata_command_test {
namespace {

using nlohmann::json;

class Metadata : public testing::Test {
 protected:
  Metadata() { write_picture_file(folder_, "wide.exr", {"R", "G", "B", "Z"}, {48, 32}); }
  json report(const std::string& arguments) const {
    const Result result = defray(folder_, "render " + arguments + " --json");
    expect_ok(result);
    return json::parse(result.out.substr(0, result.out.find('\n')));
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, "render " + arguments), code, words, arguments);
  }
  void write(const std::string& name, const std::function<void(OIIO::ImageSpec&)>& change) const {
    OIIO::ImageBuf file(folder_ / "wide.exr");
    file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
    change(file.specmod());
    ASSERT_TRUE(file.write(folder_ / name));
  }
  Folder folder_;
};

TEST_F(Metadata, NumbersOfAnyType) {
  write("whole.exr", [](OIIO::ImageSpec& spec) {
    spec.attribute("cameraFocalLength", 35);  // an int
    spec.attribute("cameraFNumber", "2");     // a text
    const double aperture = 24;
    spec.attribute("cameraAperture", OIIO::TypeDesc::DOUBLE, &aperture);
    spec.attribute("focus", 3.5f);
  });
  const json lens = report("whole.exr -o o.exr --camera from-metadata");
  EXPECT_DOUBLE_EQ(lens["focal_length_mm"], 35);
  EXPECT_DOUBLE_EQ(lens["aperture_diameter_mm"], 17.5);
  EXPECT_DOUBLE_EQ(lens["sensor_width_mm"], 24);
  EXPECT_DOUBLE_EQ(lens["focus_distance_units"], 3.5);
}

TEST_F(Metadata, EachFrameHasItsOwn) {
  for (const int frame : {1, 2}) {
    write(fmt::format("m.000{}.exr", frame), [&](OIIO::ImageSpec& spec) {
      spec.attribute("cameraFocalLength", 40.0f + static_cast<float>(frame));
      spec.attribute("cameraFNumber", 2.0f);
      spec.attribute("focus", 1.5f * static_cast<float>(frame));
    });
  }
  const Result result =
      defray(folder_, "render m.####.exr -o o.####.exr --camera from-metadata --json");
  expect_ok(result);
  std::istringstream lines(result.out);
  for (int frame = 1; frame <= 2; ++frame) {
    std::string line;
    std::getline(lines, line);
    const json lens = json::parse(line);
    EXPECT_DOUBLE_EQ(lens["focal_length_mm"], 40 + frame);
    EXPECT_DOUBLE_EQ(lens["focus_distance_units"], 1.5 * frame);
  }
}

TEST_F(Metadata, ASensorsWidthIsThatOfAnUprightFrame) {
  write_picture_file(folder_, "wide.exr", {"R", "G", "B", "Z"}, {32, 48});
  write("tall.exr", [](OIIO::ImageSpec& spec) {
    spec.attribute("nuke/camera/focal", 50.0f);
    spec.attribute("nuke/camera/haperture", 24.0f);
  });
  const std::string tall = "tall.exr -o o.exr --camera from-metadata --focus 3 --fstop 2 ";
  const auto is_noted = [&](const std::string& options) {
    return report(tall + options)["notes"].dump().find("is upright") != std::string::npos;
  };
  EXPECT_FALSE(is_noted(""));
  EXPECT_TRUE(is_noted("--sensor-width 24"));
  EXPECT_DOUBLE_EQ(report(tall)["sensor_width_mm"], 24);
  EXPECT_DOUBLE_EQ(report(tall + "--sensor-fit auto")["sensor_width_mm"], 16);
}

TEST_F(Metadata, NamesOfRenderers) {
  write("nuke.exr", [](OIIO::ImageSpec& spec) {
    spec.attribute("nuke/camera/focal", "50.0");
    spec.attribute("nuke/camera/haperture", "24.576");
  });
  const json nuke = report("nuke.exr -o o.exr --camera from-metadata --focus 3 --fstop 2");
  EXPECT_DOUBLE_EQ(nuke["focal_length_mm"], 50);
  EXPECT_DOUBLE_EQ(nuke["sensor_width_mm"], 24.576);
  write("vray.exr", [](OIIO::ImageSpec& spec) {
    spec.attribute("cameraFov", 73.739795f);
    spec.attribute("cameraFNumber", 4.0f);
    spec.attribute("cameraTargetDistance", 1e18f);  // none
  });
  const json vray = report("vray.exr -o o.exr --camera from-metadata --focus 3 --focal-length 24");
  EXPECT_NEAR(vray["sensor_width_mm"], 36, 1e-4);
  EXPECT_DOUBLE_EQ(vray["aperture_diameter_mm"], 6);
  write("redshift.exr", [](OIIO::ImageSpec& spec) { spec.attribute("rs/camera/fov", 1.0f); });
  write("arnold.exr",
        [](OIIO::ImageSpec& spec) { spec.attribute("exr/CameraFocalLength", -35.0f); });
  const std::string name = "exr/CameraFocalLength";  // as the file spells it
  expect_refused("arnold.exr -o o.exr --camera from-metadata --focus 3 --fstop 2", 3,
                 {"'" + name + "' = '-35', which is no focal length"});
  EXPECT_NE(defray(folder_, "info arnold.exr").out.find("(" + name + ", "), std::string::npos);
  EXPECT_NE(defray(folder_, "info --json arnold.exr").out.find('"' + name + '"'),
            std::string::npos);
  EXPECT_NEAR(report("redshift.exr -o o.exr --camera from-metadata --focus 3 --fstop 2 "
                     "--focal-length 50")["sensor_width_mm"],
              100 * std::tan(0.5), 1e-5);
}

TEST_F(Metadata, AProjectionGivesTheSensor) {
  write("prman.exr", [](OIIO::ImageSpec& spec) {
    const float matrix[] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 1, 4, 0, 0, 0};  // 1/2 on either side
    spec.attribute("worldToNDC", OIIO::TypeMatrix44, matrix);
  });
  const std::string lens = "--focus 3 --fstop 2 --focal-length 50";
  const std::string command = "prman.exr -o o.exr " + lens;
  EXPECT_NEAR(report(command + " --camera from-metadata")["sensor_width_mm"], 50, 1e-5);
  EXPECT_NEAR(report(command)["sensor_width_mm"], 36, 1e-5);
  // It says itself that it is of the width.
  for (const std::string fit : {"vertical", "auto"}) {
    EXPECT_NEAR(report(command + " --camera from-metadata --sensor-fit " + fit)["sensor_width_mm"],
                50, 1e-5);
  }
  const Result info = defray(folder_, "info prman.exr");
  expect_ok(info);
  for (const std::string words : {"  fov_deg 53.1301 (worldToNDC, OpenEXR, RenderMan)",
                                  "--camera from-metadata --focus-at"}) {
    EXPECT_NE(info.out.find(words), std::string::npos) << info.out;
  }
}

TEST_F(Metadata, ErrorsNameFileAttributeAndValue) {
  write("zero.exr", [](OIIO::ImageSpec& spec) { spec.attribute("FNumber", 0.0f); });
  expect_refused("zero.exr -o o.exr --camera from-metadata --focus 3 --focal-length 50", 3,
                 {"zero.exr: its metadata has '", "FNumber' = '0', which is no f-number"});
  write("text.exr", [](OIIO::ImageSpec& spec) { spec.attribute("cameraFocalLength", "long"); });
  expect_refused("text.exr -o o.exr --camera from-metadata --focus 3 --fstop 2", 3,
                 {"'cameraFocalLength' = 'long'", "V-Ray"});
  expect_refused("wide.exr -o o.exr --camera from-metadata --fstop 2", 2,
                 {"wide.exr's metadata has no such value, sought as", "focus", "cameraFocalLength",
                  "nuke/camera/focal"});
}

TEST_F(Metadata, WhatNoLensHasIsRefused) {
  for (const std::string name : {"cameraFov", "rs/camera/fov"}) {
    write("wide_angle.exr", [&](OIIO::ImageSpec& spec) { spec.attribute(name, 180.0f); });
    expect_refused(
        "wide_angle.exr -o o.exr --camera from-metadata --focus 3 --fstop 2", 3,
        {"wide_angle.exr: its metadata has '" + name + "' = '180'", "above 0, below 180 degrees"});
  }
  write("long.exr", [](OIIO::ImageSpec& spec) { spec.attribute("cameraFocalLength", HUGE_VALF); });
  expect_refused("long.exr -o o.exr --camera from-metadata --focus 3 --fstop 2", 3,
                 {"'cameraFocalLength' = 'inf'"});
}

TEST_F(Metadata, FocusMayBeAtInfinity) {
  write("far.exr", [](OIIO::ImageSpec& spec) { spec.attribute("focus", HUGE_VALF); });
  const std::string optics = " -o o.exr --fstop 0.1 --focal-length 50";
  report("far.exr --camera from-metadata" + optics);
  const std::uint64_t from_metadata = file_hash(folder_ / "o.exr");
  report("far.exr --focus inf" + optics);
  EXPECT_EQ(file_hash(folder_ / "o.exr"), from_metadata);
}

TEST_F(Metadata, OptionsWinOverWhatCannotBeRead) {
  const struct {
    const char *attribute, *option, *stated;
  } mistakes[] = {{"nominalFocalLength", "--focal-length", "--focal-length 40"},
                  {"cameraFNumber", "--fstop", "--fstop 2"},
                  {"cameraFNumber", "--fstop", "--aperture-diameter 20"},
                  {"cameraFocusDistance", "--focus", "--focus 3"},
                  {"cameraFocusDistance", "--focus", "--focus-at 4,4"},
                  {"cameraFocusDistance", "--focus", "--focus-range 2,4"},
                  {"cameraAperture", "--sensor-width", "--sensor-width 30"},
                  {"cameraAperture", "--sensor-width", "--sensor-height 20"},
                  {"cameraFov", "--fov", "--fov 40"},
                  {"rs/camera/fov", "--fov", "--sensor-width 30"}};
  std::string value = "0";
  for (const auto& mistake : mistakes) {
    value = value == "0" ? "fifty" : "0";
    write("bad.exr", [&](OIIO::ImageSpec& spec) {
      // What no option states.
      if (mistake.option != std::string("--focal-length")) spec.attribute("IFM_focalLength", 35.0f);
      if (mistake.option != std::string("--fstop")) spec.attribute("cameraFNumber", 4.0f);
      if (mistake.option != std::string("--focus")) spec.attribute("cameraFocusDistance", 3.0f);
      spec.attribute(mistake.attribute, value);
    });
    const std::string command = "bad.exr -o o.exr --camera from-metadata ";
    expect_refused(command, 3,
                   {"' = '" + value + "'", std::string(mistake.option) + " wins over it"});
    report(command + mistake.stated);
  }
}

}  // namespace
}  // namespace defray::test::metadata_command_test
