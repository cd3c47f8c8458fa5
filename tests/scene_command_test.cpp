// defray scene as users run it.
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.h"
#include "scenes/scene.h"

namespace defray::test {
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
  expect_ok(defray(folder, "scene plate2 --setting f5" + small));
  EXPECT_TRUE(exists(folder, "truth_f5.exr"));
  EXPECT_FALSE(exists(folder, "truth_f3.exr"));
  EXPECT_EQ(camera(folder)["focus_settings"].size(), 4u);
  const Result wrong = defray(folder, "scene blocks-lake --setting minature" + small);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("Did you mean 'miniature'?"), std::string::npos) << wrong.err;
}

TEST(SceneCommand, HiddenWritesTheSecondLayer) {
  const Folder folder;
  expect_ok(defray(folder, "scene spheres --hidden --setting f2" + small));
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
  expect_ok(defray(folder, "scene spheres --setting f2" + small));
  const std::uint64_t all = file_hash(folder / "truth_f2.exr");
  std::filesystem::remove(folder / "truth_f2.exr");
  expect_ok(defray(folder, "scene spheres --setting f2" + small, "taskset -c 0"));
  EXPECT_EQ(file_hash(folder / "truth_f2.exr"), all);
}

TEST(SceneCommand, RefusesBeforeItWritesAnything) {
  const Folder folder;
  const Result samples = defray(folder, "scene plate1 -o out --truth-samples 0");
  expect_refusal(samples, 2, {"--truth-samples is 0"}, "samples");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  expect_refusal(defray(folder, "scene plate1 -o ''"), 2, {"--output", "is empty"}, "empty");
}

}  // namespace
}  // namespace defray::test
