// defray render: lenses that change over a sequence, focus on a place.
#include <cmath>
#include <fstream>
#include <sstream>

#include "command/render/camera_fixture.h"

namespace defray::test::animated_lens_test {
namespace {

using nlohmann::json;

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

/// A number that changes gives frame 2 the bits of the same number standing still.
TEST_F(Sequences, AnyNumberChanges) {
  const std::string optics = " --focus 2.5 --fstop 1 --focal-length 50 ";
  const struct {
    const char *options, *option, *changing, *second, *other;
  } numbers[] = {{"", "--cats-eye", "0.2:1,0.8:3", "0.5", "0.8"},
                 {"", "--squeeze", "1:1,2:3", "1.5", "2"},
                 {"--blades 5", "--blade-rotation", "0:1,40:3", "20", "40"},
                 {"--blades 5", "--blade-curvature", "0:1,1:3", "0.5", "1"},
                 {"", "--max-coc", "0.2:1,0.6:3", "0.4", "0.6"}};
  const auto second = [&](const std::string& input, const std::string& output,
                          const std::string& options) {
    expect_ok(defray(folder_, "render " + input + " -o " + output + optics + options));
    return file_hash(folder_ / "o.0002.exr");
  };
  for (const auto& n : numbers) {
    const auto with = [&](const char* value) {
      return fmt::format("{} {} {}", n.options, n.option, value);
    };
    const auto moved = second("s.####.exr", "o.####.exr", with(n.changing));
    EXPECT_EQ(moved, second("s.0002.exr", "o.0002.exr", with(n.second))) << n.option;
    EXPECT_NE(moved, second("s.0002.exr", "o.0002.exr", with(n.other))) << n.option;
  }
  expect_refused("s.####.exr -o o.####.exr --cats-eye 0:1,2:3" + optics, 2, {"--cats-eye", "2"});
  expect_refused("s.####.exr -o o.####.exr --max-coc 1:1,-2:3" + optics, 2,
                 {"--max-coc is -0.5 px: it must be above 0"});
}

TEST_F(Sequences, LensesOfEachKindChange) {
  const std::string lens = "--focus 2.5 --fstop 2 --focal-length 50 ";
  const auto number = [&](const std::string& options, const std::string& key) {
    std::vector<double> all;
    for (const json& frame : frames(options)) all.push_back(frame[key]);
    return all;
  };
  const auto diameters =
      number("--focus 2.5 --focal-length 50 --aperture-diameter 10:1,20:3", "aperture_diameter_mm");
  EXPECT_EQ(diameters, (std::vector<double>{10, 15, 20}));
  const double width = 48, aspect = width / 32;
  const auto widths = number(lens + "--sensor-height 20:1,10:3", "sensor_width_mm");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(widths[i], (20 - 5 * i) * aspect, 1e-9);
  const auto of_fov = number(lens + "--fov 60:1,40:3", "sensor_width_mm");
  EXPECT_NEAR(of_fov[1], 100 * std::tan(25 * M_PI / 180), 1e-9);
  const auto of_scale = number(lens + "--pixel-scale 1000:1,2000:3", "pixels_per_metre");
  EXPECT_NEAR(of_scale[1], 1500, 1e-9);
  for (const std::string display :
       {"--display-distance 0.5:1,1:3", "--display-resolution 3000:1,6000:3"}) {
    const auto by_display = number("--eye=display --focus 2.5 " + display, "pixels_per_metre");
    EXPECT_NE(by_display[0], by_display[2]) << display;
  }
}

TEST_F(Sequences, ARangeChanges) {
  const auto second = [&](const std::string& input, const std::string& output,
                          const std::string& range) {
    expect_ok(defray(folder_, "render " + input + " -o " + output +
                                  " --fstop 1 --focal-length 50 " + "--focus-range " + range));
    return file_hash(folder_ / "o.0002.exr");
  };
  const auto moved = second("s.####.exr", "o.####.exr", "1,2:1,1.5,4:3");
  EXPECT_EQ(moved, second("s.0002.exr", "o.0002.exr", "1.25,3"));
  EXPECT_NE(moved, second("s.0002.exr", "o.0002.exr", "1.25,3.5"));
  const auto smooth = second("s.####.exr", "o.####.exr", "1,2:1,1.5,4:5,smooth");
  EXPECT_EQ(smooth, second("s.0002.exr", "o.0002.exr", "1.078125,2.3125"));
  expect_refused("s.####.exr -o o.####.exr --fstop 1 --focal-length 50 --focus-range 1,2:1,3,2:3",
                 2, {"--focus-range goes from 3 to 2"});
}

TEST_F(Sequences, CurvesAreReadStrictly) {
  const auto refused = [&](const std::string& focus, const std::string& words) {
    expect_refused("s.####.exr -o o.####.exr --fstop 2 --focal-length 50 --focus " + focus, 2,
                   {"--focus", words});
  };
  refused("3:1,2", "'2' has no frame");
  refused("3,smooth", "'3' has no frame");
  refused("3:a", "'3:a' has no frame number");
  refused("x", "'x' cannot be read as a number; write a number like 2.5, without a unit (");
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
  EXPECT_NE(result.err.find("camera.0002.json: no such file"), std::string::npos) << result.err;
  // Otherwise before the first frame is rendered, but for frames that are there.
  std::filesystem::remove(folder_ / "camera.0003.json");
  const std::string all_of = "s.####.exr -o p.####.exr --camera camera.####.json";
  expect_refused(all_of, 3,
                 {"camera.0002.json: no such file: 2 of 3 frames have no camera; "
                  "--skip-bad-frames leaves them out"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.0001.exr"));
  shell(folder_, "cp s.0002.exr p.0002.exr");
  expect_refused(all_of + " --skip-existing", 3, {"camera.0003.json: no such file: 1 of 3"});
  shell(folder_, "cp s.0003.exr p.0003.exr");
  expect_ok(defray(folder_, "render " + all_of + " --skip-existing"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p.0001.exr"));
}

/// Of a camera file a frame, too; each JSON line has all.
TEST_F(Sequences, ANoteIsSaidOnce) {
  for (int i = 1; i <= 3; ++i) {
    std::ofstream(folder_ / fmt::format("camera.000{}.json", i))
        << R"({"focal_length_mm": 50, "f_stop": 2, "focus_distance_m": 4, "colour": 1})";
  }
  const std::string note = "key 'colour' is not known, and ignored";
  const auto times_said = [&](const std::string& command) {
    const std::string text = defray(folder_, command).out;
    std::size_t count = 0;
    for (std::size_t at = text.find(note); at != std::string::npos; at = text.find(note, at + 1)) {
      ++count;
    }
    return count;
  };
  const std::string render = "render s.####.exr -o o.####.exr --camera ";
  EXPECT_EQ(times_said(render + "camera.####.json"), 1u);
  EXPECT_EQ(times_said(render + "camera.0001.json"), 1u);
  EXPECT_EQ(times_said(render + "camera.####.json --json"), 3u);
  const std::string splat =
      "splat --model plane --model-points 400 --size 16x16 --frames 1-3 -o o.####.exr --camera ";
  EXPECT_EQ(times_said(splat + "camera.####.json"), 1u);
  EXPECT_EQ(times_said(splat + "camera.0001.json"), 1u);
  EXPECT_EQ(times_said(splat + "camera.####.json --json"), 3u);
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

}  // namespace
}  // namespace defray::test::animated_lens_test
