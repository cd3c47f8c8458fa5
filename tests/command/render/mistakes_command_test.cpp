// defray render: what looks like a mistake is an error or a note, with the number.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "command/render/mistakes_fixture.h"

namespace defray::test::mistakes_command_test {
namespace {

TEST_F(Mistakes, AMistPassIsNeverChosen) {
  const Plane mist(pixels, 0.25f), z(pixels, 4.0f);
  write("mist.exr", {"ViewLayer.Mist.Z"}, {mist});
  expect_refused("mist.exr -o o.exr" + usual_, {"no depth", "ViewLayer.Mist.Z is a mist pass",
                                                "Render the depth itself", "Passes, Data, Z"});
  write("both.exr", {"ViewLayer.Mist.Z", "ViewLayer.Depth.Z"}, {mist, z});
  EXPECT_NE(said("both.exr -o o.exr" + usual_).find("depth ViewLayer.Depth.Z"), std::string::npos);
  ImageFile::from_planes({"Mist.Z"}, {mist}, width, height).write(folder_ / "alone.exr");
  expect_refused("both.exr --depth alone.exr -o o.exr" + usual_, {"alone.exr", "mist pass"});
  for (const std::string name : {"VRayAtmosphere.Z", "VRayMist.Z", "AtmosphericEffects.Z", "fog.Z",
                                 "mist", "mist pass.Z", "AO_fog.Z"}) {
    write("other.exr", {name}, {mist});
    expect_refused("other.exr -o o.exr" + usual_, {name + " is a mist pass"});
  }
  const std::string named = "both.exr -o o.exr --depth-channel ViewLayer.Mist.Z" + usual_;
  expect_note(named, "ViewLayer.Mist.Z is a mist pass, clamped");
  EXPECT_EQ(said(named + "--depth-kind normalized --near 0 --far 20").find("mist pass"),
            std::string::npos);
}

TEST_F(Mistakes, NegativeDepthsAreCountedAndNamed) {
  Plane z(pixels, -4.0f);
  write("minus.exr", {"Z"}, {z});
  expect_refused("minus.exr -o o.exr" + usual_,
                 {"minus.exr: depth is negative in 384 px (100.0 % of all)", "camera-space -z",
                  "--depth-kind negative-z"});
  write("plus.exr", {"Z"}, {Plane(pixels, 4.0f)});
  expect_ok(defray(folder_, "render plus.exr -o a.exr" + usual_));
  expect_ok(defray(folder_, "render minus.exr -o b.exr --depth-kind negative-z" + usual_));
  EXPECT_EQ(ImageFile::read(folder_ / "a.exr").plane(0, 0),
            ImageFile::read(folder_ / "b.exr").plane(0, 0));
  expect_refused("plus.exr -o o.exr --depth-kind negative-z" + usual_,
                 {"depth is positive in 384 px", "--depth-kind z"});
  z.assign(pixels, 4.0f);
  z[7] = z[9] = -1;
  write("few.exr", {"Z"}, {z});
  expect_note("few.exr -o o.exr" + usual_,
              "depth is negative in 2 px (0.5 %), taken as background; camera-space -z is "
              "--depth-kind negative-z");
}

TEST_F(Mistakes, AFewPositiveDepthsAmongNegativeOnesAreBackground) {
  Plane z(pixels, -4.0f);
  z[3] = 2;
  write("minus.exr", {"Z"}, {z});
  expect_note("minus.exr -o o.exr --depth-kind negative-z" + usual_,
              "depth is positive in 1 px (0.3 %), taken as background\n");
}

TEST_F(Mistakes, AGpusDepthBufferIsRead) {
  write("plain.exr", {"Z"}, {Plane(pixels, 4.0f)});
  write("buffer.exr", {"Z"}, {Plane(pixels, (1 - 1 / 4.0f) / (1 - 1 / 9.0f))});
  const std::string range = " --depth-kind zbuffer --near 1 --far 9";
  EXPECT_NE(said("buffer.exr -o o.exr" + range + usual_).find("depth Z, 4 to 4 units"),
            std::string::npos);
  expect_ok(defray(folder_, "render plain.exr -o p.exr" + usual_));
  expect_ok(defray(folder_, "compare o.exr p.exr --min-psnr 60"));
}

TEST_F(Mistakes, WholeNumbersMakePoorDepths) {
  write("in.exr", {"Z"}, {Plane(pixels, 4.0f)});
  cv::imwrite(folder_ / "z8.png", cv::Mat(height, width, CV_8UC1, cv::Scalar(100)));
  cv::imwrite(folder_ / "z16.png", cv::Mat(height, width, CV_16UC1, cv::Scalar(30000)));
  cv::imwrite(folder_ / "rgb.png", cv::Mat(height, width, CV_8UC3, cv::Scalar::all(99)));
  const std::string range = " --depth-kind normalized --near 1 --far 9";
  expect_note("in.exr --depth z8.png -o o.exr" + usual_, "the depth has 8 bits, 256 steps");
  expect_note("in.exr --depth z8.png -o o.exr" + range + usual_, "the depth has 8 bits");
  expect_note("in.exr --depth z16.png -o o.exr" + usual_,
              "the depth is stored as whole numbers of 16 bits, 0 to 1, and taken as 0.457771 to "
              "0.457771 units: a range from near to far is --depth-kind normalized");
  EXPECT_EQ(said("in.exr --depth z16.png -o o.exr" + range + usual_).find("whole numbers"),
            std::string::npos);
  EXPECT_EQ(said("in.exr --depth z16.png -o o.exr --depth-kind inverse" + usual_).find("whole"),
            std::string::npos)
      << "asked for";
  EXPECT_EQ(said("in.exr -o o.exr" + usual_).find("bits"), std::string::npos);
  expect_refused("in.exr --depth rgb.png -o o.exr" + usual_,
                 {"rgb.png: no depth",
                  "Name its file with --depth, or its channel with --depth-channel (R where the "
                  "depth is stored as grey). It has: R G B"});
  EXPECT_NE(said("in.exr --depth rgb.png --depth-channel R -o o.exr" + range + usual_)
                .find("depth R, 4.10588"),
            std::string::npos);
}

TEST_F(Mistakes, FocusOutsideAllDepths) {
  Plane z(pixels, 4.0f);
  z[5] = 2;
  write("in.exr", {"Z"}, {z});
  const std::string optics = " --fstop 8 --focal-length 50 ";
  expect_note("in.exr -o o.exr --focus 30" + optics,
              "focus 30 lies outside all depths, 2 to 4 units");
  expect_note("in.exr -o o.exr --focus 1" + optics, "focus 1 lies outside all depths");
  expect_note("in.exr -o o.exr --focus inf" + optics, "focus inf lies outside all depths");
  // As near as depths of 8 bits are to what they stand for is not outside.
  for (const std::string inside : {"2", "3", "4", "4.03", "1.985"}) {
    EXPECT_EQ(said("in.exr -o o.exr --focus " + inside + optics).find("lies outside"),
              std::string::npos)
        << inside;
  }
  z[6] = HUGE_VALF;
  write("sky.exr", {"Z"}, {z});
  EXPECT_EQ(said("sky.exr -o o.exr --focus inf" + optics).find("lies outside"), std::string::npos);
  expect_note("sky.exr -o o.exr --focus 30" + optics, "focus 30 lies outside");
}

TEST_F(Mistakes, BlurThatNoOneSeesOrThatHidesAll) {
  Plane z(pixels, 4.0f);
  z[5] = 2;
  write("in.exr", {"Z"}, {z});
  expect_note("in.exr -o o.exr --focus 4 --fstop 64 --focal-length 50",
              "all CoC radii are below half a pixel, the largest is 0.0");
  expect_note("in.exr -o o.exr --focus 2.1 --aperture-diameter 1000 --focal-length 50",
              "CoC radii are above 0.96 px, 4 % of the width, in 99.7 % of the picture");
  const std::string text =
      said("in.exr -o o.exr --focus 2 --aperture-diameter 300 --focal-length 50");
  EXPECT_EQ(text.find("half a pixel"), std::string::npos) << text;
  EXPECT_NE(text.find("in 99.7 %"), std::string::npos) << text;
  const std::string pinhole =
      said("in.exr -o o.exr --focus 4 --aperture-diameter 0 --focal-length 50");
  EXPECT_EQ(pinhole.find("half a pixel"), std::string::npos) << pinhole;
}

TEST_F(Mistakes, LensesThatNoOneBuilds) {
  write("in.exr", {"Z"}, {Plane(pixels, 4.0f)});
  const std::string in = "in.exr -o o.exr --focus 3 ";
  expect_note(in + "--fstop 2 --focal-length 0.05",
              "focal length 0.05 mm is ten times off any real one (1.5 to 2000)");
  expect_note(in + "--fstop 2 --focal-length 0.05 --sensor-width 0.036", "sensor 0.036 mm");
  expect_note(in + "--fstop 2 --focal-length 0.05 --sensor-height 0.024", "sensor 0.024 mm");
  expect_note(in + "--aperture-diameter 1000 --focal-length 50", "f-number 0.05 is ten times");
  expect_note(in + "--fstop 1000 --focal-length 50",
              "f-number 1000 is ten times off any real one (0.7 to 64): is it right?");
  const std::string usual = said(in + "--fstop 2 --focal-length 50");
  EXPECT_EQ(usual.find("ten times"), std::string::npos) << usual;
  EXPECT_EQ(said("in.exr -o o.exr --eye --focus 3 --perceived-distance 0.06").find("ten times"),
            std::string::npos);
}

TEST_F(Mistakes, KeysOfACameraFileThatNoOneReads) {
  write("in.exr", {"Z"}, {Plane(pixels, 4.0f)});
  const auto camera = [&](const std::string& text) {
    std::ofstream(folder_ / "camera.json") << text;
    return std::string("in.exr -o o.exr --camera camera.json ");
  };
  expect_note(camera(R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2,
                         "sensor_widht_mm": 24})"),
              "camera.json: key 'sensor_widht_mm' is not known, and ignored; did you mean "
              "'sensor_width_mm'?");
  expect_note(camera(R"({"focal_length_mm": 50, "focus_settings": {"a": {"focus_distance_m": 3,
                         "f_stop": 2, "colour": "red"}}})"),
              "camera.json: key 'colour' is not known, and ignored\n");
  const std::string unused = "camera.json: key 'blades' is not used: ";
  const std::string iris = unused + "--blades 6 is such an aperture";
  expect_note(camera(R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2, "blades": 6})"),
              iris);
  const std::string of_a_setting =
      camera(R"({"focal_length_mm": 50, "focus_settings": {"a": {"focus_distance_m": 3,
                 "f_stop": 2, "blades": 6}}})");
  expect_note(of_a_setting, iris);
  const auto said_by = [&](const std::string& command) {
    return defray(folder_, command + " --camera camera.json").err;
  };
  const std::string beside = "note: " + unused + "render's --blades 6 is such an aperture\n";
  EXPECT_EQ(said_by("psf --depth 4"), "defray: " + beside);
  const Result drawn =
      defray(folder_, "splat --model plane --model-points 400 -o p.exr --camera camera.json");
  EXPECT_EQ(drawn.err, "");
  EXPECT_NE(drawn.out.find("\n  " + beside), std::string::npos) << drawn.out;
  const std::string trade = said_by("trade in.exr -o trade");
  EXPECT_TRUE(trade.starts_with("defray: note: " + iris + "\n")) << trade;
  const std::string round =
      camera(R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2, "blades": 0})");
  EXPECT_EQ(said(round).find("key '"), std::string::npos);
  // What is known, but of another place.
  const std::string misplaced =
      camera(R"({"focal_length_mm": 50, "f_stop": 2, "fstopp": 2, "focus_settings": {"a":
                 {"focus_distance_m": 3, "f_stop": 2, "sensor_width_mm": 24}}})");
  expect_note(misplaced,
              "camera.json: key 'f_stop' is ignored here: it belongs into a focus setting\n");
  expect_note(misplaced,
              "camera.json: key 'fstopp' is not known, and ignored; did you mean "
              "'f_stop'?");
  expect_note(misplaced,
              "camera.json: key 'sensor_width_mm' is ignored here: it belongs beside "
              "the focus settings\n");
  const std::string without_settings =
      camera(R"({"focal_length_mm": 50, "f_stop": 2, "focus_distance_m": 3,
                 "focus_settings": {}})");
  EXPECT_EQ(said(without_settings).find("key '"), std::string::npos);
  camera(R"({"focal_length_mm": 50, "focus_distance_m": 3, "fstopp": 2})");
  const std::string splat =
      defray(folder_, "splat --model plane -o p.exr --camera camera.json").err;
  EXPECT_NE(splat.find("'fstopp'"), std::string::npos) << splat;
  EXPECT_EQ(splat.find("'fstopp'"), splat.rfind("'fstopp'")) << "said once: " << splat;
  camera(R"({"focal_length_mm": 50, "focus_settings": {"a": {"focus_distance_m": 3,
             "f_stop": 2, "colour": "red"}}})");
  for (const std::string command :
       {"compare in.exr in.exr --depth in.exr --camera camera.json --focus-setting a",
        "psf --depth 4 --camera camera.json --focus-setting a",
        "trade in.exr -o trade --camera camera.json --focus-setting a"}) {
    const Result result = defray(folder_, command);
    expect_ok(result);
    EXPECT_NE(
        result.err.find("defray: note: camera.json: key 'colour' is not known, and ignored\n"),
        std::string::npos)
        << command << "\n"
        << result.err;
  }
  const std::string incomplete =
      camera(R"({"focal_length_mm": 50, "focusDistance": 3, "fstop": 2})");
  expect_refusal(defray(folder_, "render " + incomplete), 2,
                 {"the lens is not complete: give --focus, --fstop or --aperture-diameter",
                  "camera.json has no such value, sought as focus_distance_m; f_stop or "
                  "aperture_diameter_m",
                  "'focusDistance'", "did you mean 'focus_distance_m'? Note: ", "'f_stop'?"},
                 incomplete);
  EXPECT_EQ(said(camera(R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2, "scene": "x",
                            "frame": 3})"))
                .find("is not known"),
            std::string::npos);
}

TEST_F(Mistakes, WeakSpellings) {
  write("in.exr", {"Z"}, {Plane(pixels, 4.0f)});
  const auto refused = [&](const std::string& command, int code,
                           const std::vector<std::string>& words) {
    expect_refusal(defray(folder_, command), code, words, command);
  };
  refused(
      "render in.exr -o o.exr --aperture 2", 2,
      {"unknown option '--aperture'. There are --fstop, --aperture-diameter, --aperture-image"});
  refused("render in.exr b.exr c.exr -o o.exr" + lens, 2,
          {"unknown argument 'b.exr'", "####", "in quotes"});
  refused("render in.exr -o o.####.exr" + lens, 2,
          {"o.####.exr: has a frame pattern, the input in.exr has none; --no-pattern"});
  refused("render 'in.*.exr' -o o.####.exr" + lens, 2,
          {"has a frame pattern, the input in.*.exr has none: write #### for its *; --no-pattern"});
  refused("compare in.exr", 2, {"b is missing: Picture of the same size", "compare --help"});
  refused("render in.exr", 2, {"--output is missing: EXR", "render --help"});
  refused("render in.exr -o o.exr --layer beauti" + lens, 3,
          {"no colour in layer 'beauti'", "Leave --layer out"});
  refused("render in.exr -o o.png --bits 12" + lens, 2,
          {"--bits '12' is not known. Allowed: 8 16"});
  refused("render in.exr -o o.exr --depth-kind normalized --far 20" + lens, 2,
          {"--depth-kind normalized needs --near, which may be 0, and --far"});
  for (const std::string unit : {"meters", "Metre", "centimeters", "feet", "inches"}) {
    expect_ok(defray(folder_,
                     "render in.exr -o o.exr --focus 900 --fstop 2 --focal-length 50 "
                     "--unit " +
                         unit));
  }
}

TEST_F(Mistakes, ADepthOfNothingButBackground) {
  const std::string note = "nothing has a depth: is it the right channel?\n";
  for (const float nothing : {0.0f, NAN, INFINITY}) {
    write("in.exr", {"Z"}, {Plane(pixels, nothing)});
    const std::string of_it = std::isnan(nothing) ? " (384 px NaN), " : ", ";
    expect_note("in.exr -o o.exr" + usual_, "all of Z is background" + of_it + note);
  }
  Plane one(pixels, 0.0f);
  one[5] = 4;
  write("in.exr", {"Z"}, {one});
  EXPECT_EQ(said("in.exr -o o.exr" + usual_).find("is background"), std::string::npos);
}

TEST_F(Mistakes, AnEyeOfWhichLittleIsLeft) {
  write("in.exr", {"Z"}, {Plane(pixels, 4.0f)});
  const std::string note =
      "of --eye only its 28000 px per metre are used: the aperture and the "
      "focal length given beside it win\n";
  for (const std::string aperture : {"--fstop 1", "--aperture-diameter 20"}) {
    const std::string eye = "--eye --focus 3 --focal-length 50 " + aperture;
    expect_note("in.exr -o o.exr " + eye, note);
    const Result drawn = defray(folder_, "splat --model plane --model-points 400 -o p.exr " + eye);
    EXPECT_EQ(drawn.err, "");
    EXPECT_NE(drawn.out.find("\n  note: " + note), std::string::npos) << drawn.out;
    EXPECT_EQ(said("in.exr -o o.exr --eye --focus 3 " + aperture).find("of --eye"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace defray::test::mistakes_command_test
