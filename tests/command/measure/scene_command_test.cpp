// defray scene as users run it.
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "scenes/scene.h"

namespace defray::test::scene_command_test {
namespace {

const std::string small = " -o . --width 40 --height 30 --truth-samples 4";

bool exists(const Folder& folder, const std::string& name) {
  return std::filesystem::exists(folder / name);
}

nlohmann::json camera(const Folder& folder) {
  std::ifstream stream(folder / "camera.json");
  return nlohmann::json::parse(stream);
}

TEST(SceneCommand, WritesATruthForEachSettingThatRenderReads) {
  const Folder folder;
  const Result result = defray(folder, "scene fence" + small);
  expect_ok(result);
  EXPECT_NE(result.out.find("truth_bg.exr"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("dB"), std::string::npos) << result.out;
  EXPECT_NE(file_hash(folder / "truth_bg.exr"), file_hash(folder / "truth_fence.exr"));
  EXPECT_FALSE(exists(folder, "truth.exr"));
  EXPECT_FALSE(exists(folder, "hidden.exr"));
  const nlohmann::json setting = camera(folder)["focus_settings"]["fence"];
  EXPECT_EQ(setting["focus_distance_m"], 1.5);
  EXPECT_GT(setting["truth_noise_psnr_srgb_db"], 10);
  EXPECT_GT(setting["truth_noise_psnr_linear_db"], 10);
  expect_ok(defray(folder, "render pinhole.exr -o a.exr --camera camera.json --focus-setting bg"));
  expect_ok(
      defray(folder, "render pinhole.exr -o b.exr --camera camera.json --focus-setting fence"));
  EXPECT_NE(file_hash(folder / "a.exr"), file_hash(folder / "b.exr"));
}

TEST(SceneCommand, OneSettingIsPlainTruth) {
  const Folder folder;
  expect_ok(defray(folder, "scene slanted" + small));
  EXPECT_TRUE(exists(folder, "truth.exr"));
  const std::uint64_t four = file_hash(folder / "truth.exr");
  expect_ok(defray(folder, "scene slanted" + small + " --seed 2"));
  EXPECT_NE(file_hash(folder / "truth.exr"), four);
  expect_ok(defray(folder, "scene slanted -o . --width 40 --height 30 --truth-samples 1"));
  EXPECT_NE(file_hash(folder / "truth.exr"), four);
  EXPECT_FALSE(camera(folder)["focus_settings"]["default"].contains("truth_noise_psnr_srgb_db"));
}

TEST(SceneCommand, SettingChoosesOne) {
  const Folder folder;
  expect_ok(defray(folder, "scene plate2 --focus-setting f5" + small));
  EXPECT_TRUE(exists(folder, "truth_f5.exr"));
  EXPECT_FALSE(exists(folder, "truth_f3.exr"));
  EXPECT_EQ(camera(folder)["focus_settings"].size(), 4u);
  const Result wrong = defray(folder, "scene blocks-lake --focus-setting minature" + small);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("Did you mean 'miniature'?"), std::string::npos) << wrong.err;
}

TEST(SceneCommand, HiddenWritesTheSecondLayer) {
  const Folder folder;
  expect_ok(defray(folder, "scene spheres --hidden --focus-setting f2" + small));
  const ImageFile hidden = ImageFile::read(folder / "hidden.exr");
  ASSERT_EQ(hidden.parts()[0].channels, (std::vector<std::string>{"R", "G", "B", "Z"}));
  const Plane front = ImageFile::read(folder / "pinhole.exr").plane(0, 3);
  const Plane back = hidden.plane(0, 3);
  for (std::size_t i = 0; i < front.size(); ++i) EXPECT_GE(back[i], front[i]);
}

TEST(SceneCommand, HelpListsEveryScene) {
  const Folder folder;
  const Result help = defray(folder, "scene --help");
  expect_ok(help);
  for (const SceneInfo& info : scene_list()) {
    EXPECT_NE(help.out.find(info.name), std::string::npos) << info.name;
    EXPECT_NE(help.out.find(info.about), std::string::npos) << info.name;
  }
  const Result wrong = defray(folder, "scene blocks-lak -o .");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("Did you mean 'blocks-lake'?"), std::string::npos) << wrong.err;
}

TEST(SceneCommand, OneCoreGivesTheSameBits) {
  const Folder folder;
  expect_ok(defray(folder, "scene spheres --focus-setting f2" + small));
  const std::uint64_t all = file_hash(folder / "truth_f2.exr");
  std::filesystem::remove(folder / "truth_f2.exr");
  expect_ok(defray(folder, "scene spheres --focus-setting f2" + small, "taskset -c 0"));
  EXPECT_EQ(file_hash(folder / "truth_f2.exr"), all);
}

TEST(SceneCommand, PinholeSamplesSmoothColourAndAntialiasedDepthTheDepth) {
  const Folder folder;
  const std::string command = "scene cutout --focus-setting near" + small;
  const auto plane = [&](int channel) {
    return ImageFile::read(folder / "pinhole.exr").plane(0, channel);
  };
  expect_ok(defray(folder, command + " --pinhole-samples 1"));
  const Plane red = plane(0), depth = plane(3);
  expect_ok(defray(folder, command));
  EXPECT_NE(plane(0), red);
  EXPECT_EQ(plane(3), depth);
  expect_ok(defray(folder, command + " --antialiased-depth"));
  EXPECT_NE(plane(3), depth);
}

TEST(SceneCommand, AlphaIsAChannelAndLeavesTheBackgroundOut) {
  const Folder folder;
  expect_ok(defray(folder, "scene spheres --focus-setting f2" + small));
  const Plane sky = ImageFile::read(folder / "pinhole.exr").plane(0, 2);
  const Result result = defray(folder, "scene spheres --focus-setting f2 --hidden --alpha" + small);
  expect_ok(result);
  EXPECT_NE(result.out.find("its alpha is about"), std::string::npos) << result.out;
  EXPECT_EQ(ImageFile::read(folder / "hidden.exr").parts()[0].channels,
            (std::vector<std::string>{"R", "G", "B", "A", "Z"}));
  EXPECT_EQ(ImageFile::read(folder / "truth_f2.exr").parts()[0].channels,
            (std::vector<std::string>{"R", "G", "B", "A"}));
  const ImageFile file = ImageFile::read(folder / "pinhole.exr");
  const Plane blue = file.plane(0, 2), alpha = file.plane(0, 3);
  EXPECT_GT(sky[0], 0);
  EXPECT_EQ(blue[0], 0);
  EXPECT_EQ(alpha[0], 0);
  EXPECT_EQ(alpha.back(), 1);
  EXPECT_EQ(blue.back(), sky.back());
}

TEST(SceneCommand, FramesWriteASequence) {
  const Folder folder;
  expect_ok(defray(folder, "scene drift --focus-setting face --hidden --frames 1,24" + small));
  for (const char* name : {"pinhole", "hidden", "truth_face"}) {
    const std::string first = name + std::string(".0001.exr"),
                      last = name + std::string(".0024.exr");
    EXPECT_NE(file_hash(folder / first), file_hash(folder / last)) << name;
  }
  EXPECT_FALSE(exists(folder, "pinhole.0002.exr"));
  EXPECT_FALSE(exists(folder, "pinhole.exr"));
  EXPECT_TRUE(camera(folder)["focus_settings"]["face"].contains("truth_noise_psnr_srgb_db"));
  expect_ok(defray(folder, "scene drift --focus-setting face" + small));
  EXPECT_EQ(file_hash(folder / "pinhole.exr"), file_hash(folder / "pinhole.0001.exr"));
}

TEST(SceneCommand, RefusesBeforeItWritesAnything) {
  const Folder folder;
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"plate1 --truth-samples 0", {"--truth-samples is 0"}},
      {"plate1 --pinhole-samples 0", {"--pinhole-samples is 0: allowed are 1 to 65536"}},
      {"plate1 --antialiased-depth --pinhole-samples 1",
       {"--antialiased-depth with --pinhole-samples 1"}},
      {"fence --frames 1-3", {"--frames: scene 'fence' does not move"}},
      {"drift --frames 20-25", {"scene 'drift' has no frame 25: allowed are 1 to 24"}},
      {"drift --frames 0", {"scene 'drift' has no frame 0"}},
      {"drift --frames a-b", {"--frames 'a-b'"}},
      {"drift --focus-setting fase", {"no focus setting 'fase'", "Did you mean 'face'?"}}};
  for (const auto& [arguments, words] : cases) {
    expect_refusal(defray(folder, "scene -o out " + arguments), 2, words, arguments);
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  }
  expect_refusal(defray(folder, "scene plate1 -o ''"), 2, {"--output", "is empty"}, "empty");
  std::ofstream(folder / "file") << "a file";
  for (const std::string command : {"scene plate1", "validate --quick"}) {
    expect_refusal(defray(folder, command + " -o file/in"), 4,
                   {"file/in: cannot create this folder: Not a directory"}, command);
  }
}

}  // namespace
}  // namespace defray::test::scene_command_test
