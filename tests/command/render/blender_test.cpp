// cli/blender/defray_camera.py, in Blender where it is installed (Debian's, in the background).
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::blender_test {
namespace {

using nlohmann::json;

const std::string here = std::string(DEFRAY_SOURCE_DIR) + "/tests/command/render/blender_scene.py";
const std::string script = std::string(DEFRAY_SOURCE_DIR) + "/cli/blender/defray_camera.py";

class Blender : public testing::Test {
 protected:
  void SetUp() override {
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

TEST_F(Blender, RendersThroughTheLensAreCyclesOwn) {
  SKIP_UNLESS_FULL();
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
