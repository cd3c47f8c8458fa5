// defray info: what it tells of a file, and that the command it suggests works.
#include <OpenImageIO/imagebuf.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::info_command_test {
namespace {

using nlohmann::json;

struct Info : testing::Test {
  std::string text(const std::string& file) const {
    const Result result = defray(folder, "info " + file);
    expect_ok(result);
    return result.out;
  }
  json data(const std::string& file) const {
    const Result result = defray(folder, "info --json " + file);
    expect_ok(result);
    return json::parse(result.out);
  }
  void expect_lines(const std::string& file, const std::vector<std::string>& lines) const {
    const std::string all = text(file);
    for (const std::string& line : lines) {
      EXPECT_NE(all.find(line + "\n"), std::string::npos) << line << " in\n" << all;
    }
  }
  /// Runs what is suggested.
  json suggested(const std::string& file) const {
    const std::string command = data(file)["command"];
    EXPECT_TRUE(command.starts_with("defray render ")) << command;
    const Result result = shell(folder, program() + command.substr(6) + " --json");
    expect_ok(result);
    return json::parse(result.out);
  }
  void write(const std::string& name, const std::vector<std::string>& channels,
             const std::vector<float>& values) const {
    std::vector<Plane> planes;
    for (const float value : values) planes.emplace_back(64, value);
    for (std::size_t i = 3; i < planes.size(); ++i) planes[i][0] = 1e10f;
    ImageFile::from_planes(channels, planes, 8, 8, Sample::single_float).write(folder / name);
  }
  Folder folder;
};

TEST_F(Info, OfABlenderFile) {
  write("shot.exr",
        {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
         "ViewLayer.Depth.Z", "ViewLayer.Mist.Z"},
        {0.1f, 0.2f, 0.3f, 4, 0.5f});
  expect_lines("shot.exr",
               {"  part 0: data window 8x8+0+0, display window 8x8+0+0",
                "    ViewLayer.Combined: R G B", "    ViewLayer.Depth: Z",
                "  colour ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B",
                "  depth ViewLayer.Depth.Z: 4 to 4, background 1 px",
                "  depth ViewLayer.Mist.Z: 0.5 to 0.5, background 1 px, a mist pass: no depth",
                "  no lens among the metadata",
                "  defray render shot.exr -o out.exr --focus-at 4,4 --fstop 2.8 --focal-length 50 "
                "--sensor-width 36"});
  EXPECT_EQ(suggested("shot.exr")["focus_distance_units"], 4);
  const json all = data("shot.exr");
  EXPECT_EQ(all["parts"][0]["data_window"], (json{0, 0, 8, 8}));
  EXPECT_EQ(all["depth_candidates"][0], (json{{"channel", "ViewLayer.Depth.Z"},
                                              {"part", 0},
                                              {"mist", false},
                                              {"smallest", 4.0},
                                              {"largest", 4.0},
                                              {"background_px", 1},
                                              {"negative_px", 0}}));
  EXPECT_EQ(all["depth_candidates"][1]["mist"], true);
  EXPECT_EQ(all["camera"], json::array());
}

TEST_F(Info, OfALensAmongTheMetadata) {
  write("plain.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, -4});
  OIIO::ImageBuf file(folder / "plain.exr");
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  file.specmod().attribute("cameraFocalLength", 35);
  file.specmod().attribute("cameraAperture", 24.5f);
  file.write(folder / "it's.exr");
  expect_lines("\"it's.exr\"", {"  focal_length_mm 35 (cameraFocalLength, V-Ray, Arnold)",
                                "  sensor_width_mm 24.5 (cameraAperture, V-Ray)",
                                "  depth Z: -4 to -4, background 1 px, negative 63 px",
                                "  defray render 'it'\\''s.exr' -o out.exr --depth-kind negative-z "
                                "--camera from-metadata --focus-at 4,4 --fstop 2.8"});
  EXPECT_EQ(suggested("\"it's.exr\"")["focal_length_mm"], 35);
  file.write(folder / "lens.exr");
  EXPECT_EQ(data("lens.exr")["command"],
            "defray render lens.exr -o out.exr --depth-kind negative-z --camera from-metadata "
            "--focus-at 4,4 --fstop 2.8");
  EXPECT_EQ(suggested("lens.exr")["focal_length_mm"], 35);
  EXPECT_EQ(data("lens.exr")["camera"][0], (json{{"field", "focal_length_mm"},
                                                 {"attribute", "cameraFocalLength"},
                                                 {"value", "35"},
                                                 {"usable", true}}));
}

TEST_F(Info, OfALensThatIsNotUsable) {
  write("plain.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 4});
  const auto with = [&](const std::function<void(OIIO::ImageSpec&)>& change) {
    OIIO::ImageBuf file(folder / "plain.exr");
    file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
    change(file.specmod());
    file.write(folder / "lens.exr");
  };
  with([](OIIO::ImageSpec& spec) { spec.attribute("nominalFocalLength", "fifty"); });
  expect_lines("lens.exr", {"  focal_length_mm fifty (nominalFocalLength, OpenEXR), not usable: it "
                            "must be a number above 0"});
  EXPECT_EQ(data("lens.exr")["camera"][0]["usable"], false);
  EXPECT_EQ(suggested("lens.exr")["focal_length_mm"], 50);
  with([](OIIO::ImageSpec& spec) {
    spec.attribute("nominalFocalLength", 0.0f);
    spec.attribute("cameraAperture", "wide");
    spec.attribute("cameraFov", 40.0f);  // not looked at beside an aperture
    spec.attribute("aperture", 4.0f);
    spec.attribute("cameraTargetDistance", 1e18f);  // none
  });
  EXPECT_EQ(data("lens.exr")["command"],
            "defray render lens.exr -o out.exr --camera from-metadata --focus-at 4,4 "
            "--focal-length 50 --sensor-width 36");
  EXPECT_EQ(suggested("lens.exr")["aperture_diameter_mm"], 12.5);
}

TEST_F(Info, RadiansAreShownInDegrees) {
  write("plain.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 4});
  OIIO::ImageBuf file(folder / "plain.exr");
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  file.specmod().attribute("rs/camera/fov", 1.0f);
  file.write(folder / "redshift.exr");
  expect_lines("redshift.exr", {"  fov_deg 57.2958 (rs/camera/fov, Redshift)"});
}

TEST_F(Info, WhereAChoiceIsToBeMadeOrSomethingIsMissing) {
  write("two.exr", {"R", "G", "B", "depth.Z", "zdepth.Z"}, {0.1f, 0.2f, 0.3f, 4, 5});
  EXPECT_NE(data("two.exr")["command"].get<std::string>().find("--depth-channel depth.Z"),
            std::string::npos);
  suggested("two.exr");
  write("flat.exr", {"R", "G", "B"}, {0.1f, 0.2f, 0.3f});
  expect_lines("flat.exr", {"  no depth: give it with --depth FILE"});
  EXPECT_EQ(data("flat.exr")["command"],
            "defray render flat.exr -o out.exr --depth FILE --focus-at 4,4 --fstop 2.8 "
            "--focal-length 50 --sensor-width 36");
  write("normals.exr", {"N.X", "N.Y", "N.Z"}, {0.1f, 0.2f, 0.3f});
  EXPECT_NE(text("normals.exr").find("\n  no colour: no layer has channels R"), std::string::npos);
  write("nothing.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 1e10f});
  expect_lines("nothing.exr", {"  depth Z: nothing but background, 64 px"});
  EXPECT_NE(text("nothing.exr").find("-o out.exr --depth FILE --focus-at 4,4"), std::string::npos);
  write("second.exr", {"R", "G", "B", "Z", "back.Z"}, {0.1f, 0.2f, 0.3f, 1e10f, 4});
  EXPECT_EQ(suggested("second.exr")["depth_channel"], "back.Z");
  expect_refusal(defray(folder, "info none.exr"), 3, {"none.exr: no such file"}, "info");
}

TEST_F(Info, SuggestsAPlaceWhereThereIsSomething) {
  write("plain.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 4});
  const auto expect_place = [&](const std::string& place, const std::string& change) {
    expect_ok(shell(folder, "oiiotool plain.exr " + change + " -o changed.exr"));
    const std::string command = data("changed.exr")["command"];
    EXPECT_NE(command.find("--focus-at " + place + " "), std::string::npos) << command;
    suggested("changed.exr");
  };
  expect_place("6,6", "--origin +6+5 --fullsize 8x8+0+0");  // 6,5 is background
  expect_place("3,0", "--origin -4-7 --fullsize 8x8+0+0");
  const std::string sky = "--fill:color=0.1,0.2,0.3,1e10 ";
  expect_place("6,4", sky + "6x8+0+0");
  expect_place("4,3", sky + "8x5+0+3 --fill:color=0.1,0.2,0.3,5 1x1+4+3");
  write("flat.exr", {"R", "G", "B"}, {0.1f, 0.2f, 0.3f});
  expect_ok(shell(folder, "oiiotool flat.exr --origin +6+5 --fullsize 8x8+0+0 -o changed.exr"));
  EXPECT_NE(text("changed.exr").find("--focus-at 6,5 "), std::string::npos);
}

TEST_F(Info, SuggestsTheFitOfUprightFrames) {
  write("plain.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 4});
  expect_ok(shell(folder, "oiiotool plain.exr --fullsize 8x9+0+0 -o upright.exr"));
  const std::string command = data("upright.exr")["command"];
  EXPECT_NE(command.find("--sensor-width 36 --sensor-fit auto"), std::string::npos) << command;
  EXPECT_NEAR(suggested("upright.exr")["sensor_width_mm"], 32, 1e-6);
}

TEST_F(Info, ListsEachPart) {
  write("a.exr", {"R", "G", "B", "Z"}, {0.1f, 0.2f, 0.3f, 4});
  write("b.exr", {"glow.R", "glow.G", "glow.B"}, {0.1f, 0.2f, 0.3f});
  expect_ok(shell(folder, "oiiotool a.exr b.exr --siappend -o both.exr"));
  const json parts = data("both.exr")["parts"];
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0]["channels"], (std::vector<std::string>{"R", "G", "B", "Z"}));
  EXPECT_EQ(parts[1]["channels"], (std::vector<std::string>{"glow.R", "glow.G", "glow.B"}));
  EXPECT_EQ(data("both.exr")["depth_candidates"][0]["part"], 0);
}

TEST_F(Info, OfAPointCloud) {
  const auto cloud = [&](double unit) {
    std::ofstream points(folder / "scan.ply");
    points << "ply\nformat ascii 1.0\nelement vertex 400\nproperty double x\nproperty double y\n"
              "property double z\nproperty float confidence\nproperty uchar red\nproperty uchar "
              "green\nproperty uchar blue\nend_header\n";
    for (int i = 0; i < 400; ++i) {
      points << unit * (5 + i % 20 / 10.0) << ' ' << unit * (i / 20 / 10.0) << ' ' << unit * (i % 7)
             << " 1 250 9 9\n";
    }
  };
  cloud(1);
  expect_lines("scan.ply", {"  points: 400", "  x 5 to 6.9", "  y 0 to 1.9", "  z 0 to 6",
                            "  given: places, colours", "  not used: confidence", "try:"});
  for (const double unit : {1e-4, 1.0, 1e6}) {
    cloud(unit);
    const json told = data("scan.ply");
    EXPECT_EQ(told["points"], 400);
    EXPECT_NEAR(told["most"][0], 6.9 * unit, 1e-6 * unit);
    EXPECT_EQ(told["given"], json::array({"colours"}));
    EXPECT_EQ(told["notes"], json::array({"not used: confidence"}));
    const std::string command = told["command"];
    const Result drawn = shell(folder, program() + command.substr(6) + " --json");
    expect_ok(drawn);
    const json picture = json::parse(drawn.out);
    EXPECT_GT(picture["seen"], 300) << command;
    EXPECT_NEAR(picture["farthest_coc_px"], 8, 5) << command;
  }
  expect_refusal(defray(folder, "info none.ply"), 3, {"none.ply: no such file"}, "none");
  expect_refusal(defray(folder, "splat s.####.ply -o o.####.png --fstop 2"), 2,
                 {"s.####.ply: one cloud goes with all frames"}, "frames");
}

TEST_F(Info, SuggestsTheOnlyChannelThatCouldBeDepth) {
  write("french.exr", {"red", "green", "blue", "profondeur"}, {0.1f, 0.2f, 0.3f, 4});
  expect_lines("french.exr", {"  no depth by its name: is it profondeur? --depth-channel "
                              "profondeur, or --depth FILE"});
  EXPECT_EQ(suggested("french.exr")["focus_distance_units"], 4);
  write("more.exr", {"R", "G", "B", "one", "two"}, {0.1f, 0.2f, 0.3f, 4, 4});
  expect_lines("more.exr", {"  no depth: give it with --depth FILE"});
}

TEST_F(Info, SuggestsALayerWhereSeveralCouldBeMeant) {
  write("two.exr", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B", "Z"},
        {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 4});
  EXPECT_NE(text("two.exr").find("choose with --layer or --view\n"), std::string::npos);
  const std::string command = data("two.exr")["command"];
  EXPECT_NE(command.find(" --layer a --focus-at "), std::string::npos) << command;
  EXPECT_EQ(suggested("two.exr")["colour_channels"], (json{"a.R", "a.G", "a.B"}));
}

}  // namespace
}  // namespace defray::test::info_command_test
