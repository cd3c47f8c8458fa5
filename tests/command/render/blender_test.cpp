// cli/blender/defray_camera.py, in Blender where it is installed (Debian's, in the background).
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "image/channel_names.h"

namespace defray::test::blender_test {
namespace {

using nlohmann::json;

const std::string here = std::string(DEFRAY_SOURCE_DIR) + "/tests/command/render/blender_scene.py";
const std::string script = std::string(DEFRAY_SOURCE_DIR) + "/cli/blender/defray_camera.py";

class Blender : public testing::Test {
 protected:
  void SetUp() override {
    SKIP_UNLESS_FULL();
    if (shell(folder_, "command -v blender").code != 0) GTEST_SKIP() << "needs blender";
  }
  std::string blender(const std::string& arguments) const {
    const Result result = shell(folder_, "blender -noaudio -b " + arguments);
    EXPECT_EQ(result.code, 0) << result.err << result.out;
    return result.out;
  }
  void build(const std::string& size) const {
    blender("--factory-startup -P '" + here + "' -- scene.blend " + size);
  }
  static Plane depth_of(const ImageFile& file) {
    const auto names = channel_names(file.parts());
    const auto z = std::find_if(names.begin(), names.end(),
                                [](const auto& name) { return name.full == "ViewLayer.Depth.Z"; });
    return file.plane(z->part, z->channel);
  }
  json camera(int frame) const {
    std::ifstream stream(folder_ / fmt::format("shot/camera.000{}.json", frame));
    return json::parse(stream);
  }
  Folder folder_;
};

TEST_F(Blender, TheScriptWritesTheLensOfEveryFrame) {
  build("32 48");
  const std::string said = blender("scene.blend -P '" + script + "' -- -o shot");
  EXPECT_NE(said.find("defray render '"), std::string::npos) << said;
  for (int frame = 1; frame <= 3; ++frame) {
    const json values = camera(frame);
    EXPECT_EQ(values["frame"], frame);
    EXPECT_DOUBLE_EQ(values["focal_length_mm"], 50);
    EXPECT_DOUBLE_EQ(values["sensor_width_mm"], 36);
    EXPECT_EQ(values["sensor_fit"], "auto");
    EXPECT_NEAR(values["f_stop"], 0.4, 1e-6);
    // Along the view axis, which looks down by 10 degrees; both ends move linearly or softly.
    if (frame == 2) continue;
    const double y = -1 + 1.25 * (frame - 1) - (-4 + 0.1 * frame), z = 0.5 - 1;
    const double down = 10 * M_PI / 180;
    EXPECT_NEAR(values["focus_distance_m"], y * std::cos(down) - z * std::sin(down), 1e-4);
  }
  // Every key is known.
  write_picture_file(folder_, "tall.exr", {"R", "G", "B", "Z"}, {32, 48});
  const Result tall = defray(folder_, "render tall.exr -o o.exr --camera shot/camera.0001.json");
  expect_ok(tall);
  EXPECT_EQ(tall.out.find("is not known"), std::string::npos) << tall.out;
  EXPECT_NE(tall.out.find("sensor 24 mm"), std::string::npos) << "36 mm upright: " << tall.out;
}

TEST_F(Blender, ARegionIsWhereBlenderRendersIt) {
  build("160 90");
  const std::string set =
      " --python-expr \"import bpy; r = bpy.context.scene.render; r.use_border = True; "
      "bpy.context.scene.cycles.samples = 1; r.use_crop_to_border = {}; r.border_min_x, "
      "r.border_max_x, r.border_min_y, r.border_max_y = {}\" ";
  const std::string run = "-P '" + script + "' -- --frames 2 --render -o ";
  blender("scene.blend" + fmt::format(fmt::runtime(set), "False", "0, 1, 0, 1") + run + "whole");
  const ImageFile whole = ImageFile::read(folder_ / "whole/0002.exr");
  for (const auto& [border, region] :
       {std::pair{"0.3, 0.8, 0, 0.7", Window{48, 27, 80, 63}},  // 0.7 is a little less as a float
        {"0.2, 0.7, 0.2, 0.7", {32, 27, 80, 45}},
        {"0.301, 0.799, 0.113, 0.689", {48, 28, 79, 52}}}) {
    const std::string said =
        blender("scene.blend" + fmt::format(fmt::runtime(set), "True", border) + run + "cut");
    const std::string words = fmt::format("--full-size 160x90+{}+{}\n", region.x, region.y);
    EXPECT_NE(said.find(words), std::string::npos) << border << said;
    const ImageFile cut = ImageFile::read(folder_ / "cut/0002.exr");
    ASSERT_EQ(cut.parts()[0].data.width, region.width) << border;
    ASSERT_EQ(cut.parts()[0].data.height, region.height) << border;
    // The depths there are those of the whole frame.
    const Plane all = depth_of(whole), part = depth_of(cut);
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        const auto from = static_cast<std::size_t>((y + region.y) * 160 + x + region.x);
        const auto to = static_cast<std::size_t>(y * region.width + x);
        ASSERT_NEAR(part[to], all[from], 1e-3 * static_cast<double>(all[from]))
            << border << " " << x << "," << y;
      }
    }
  }
}

TEST_F(Blender, FramesAreListedAsForDefray) {
  build("32 48");
  const auto write = [&](const std::string& frames) {
    shell(folder_, "rm -rf shot");
    return shell(folder_, "blender -noaudio -b scene.blend -P '" + script +
                              "' -- -o shot --frames=" + frames + "; ls shot | tr '\\n' ' '");
  };
  for (const auto& [frames, files] :
       {std::pair{"1,3", "camera.0001.json camera.0003.json "},
        {"1-5x2", "camera.0001.json camera.0003.json camera.0005.json "},
        {"3-2,7", "camera.0002.json camera.0003.json camera.0007.json "},
        {"1-4y2", "camera.0002.json camera.0004.json "}}) {
    const Result result = write(frames);
    EXPECT_TRUE(result.out.ends_with(files)) << frames << result.out << result.err;
  }
  const Result bad = write("1,b");
  EXPECT_NE(bad.err.find("'b' is not a frame range; allowed: 7, 1-8"), std::string::npos)
      << bad.err;
  EXPECT_EQ(bad.err.find("Traceback"), std::string::npos) << bad.err;
}

TEST_F(Blender, RendersThroughTheLensAreCyclesOwn) {
  for (const std::string size : {"160 90", "64 96"}) {
    build(size);
    const std::string said = blender("scene.blend -P '" + script + "' -- -o shot --render");
    blender("scene.blend -P '" + here + "' -- truth shot");
    const auto at = said.find("defray render '");
    ASSERT_NE(at, std::string::npos);
    const std::string command = said.substr(at + 6, said.find('\n', at) - at - 6);
    expect_ok(shell(folder_, program() + command));
    for (int frame = 1; frame <= 3; ++frame) {
      const auto psnr = [&](const std::string& name) {
        const Result result =
            defray(folder_, fmt::format("compare --json shot/{}000{}.exr shot/truth.000{}.exr",
                                        name, frame, frame));
        expect_ok(result);
        return json::parse(result.out)["psnr_srgb_db"].get<double>();
      };
      EXPECT_GT(psnr("lens."), psnr("") + 6) << size << ", frame " << frame;
      EXPECT_GT(psnr("lens."), 30) << size << ", frame " << frame;
    }
  }
}

}  // namespace
}  // namespace defray::test::blender_test
