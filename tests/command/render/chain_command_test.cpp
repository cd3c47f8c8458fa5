// defray render: what brings the RDB closer to the truth. Every option changes the picture, every
// wrong use is said.
#include <cmath>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::chain_command_test {
namespace {

/// A bright thin bar and a lamp in front of a wall, focused on neither; depth with or without
/// anti-aliased edges.
class ChainCommand : public testing::Test {
 protected:
  Folder folder;

  void SetUp() override {
    expect_ok(defray(folder, "scene fence -o . --width 96 --height 64 --truth-samples 1"));
    expect_ok(defray(folder,
                     "scene fence -o smooth --width 240 --height 160 --truth-samples 1 "
                     "--antialiased-depth"));
    expect_ok(defray(folder, "scene highlights -o lamps --width 96 --height 64 --truth-samples 1"));
  }

  std::uint64_t rendered(const std::string& options, const std::string& input = ".") {
    const Result result = defray(folder, "render " + input + "/pinhole.exr -o out.exr --camera " +
                                             input + "/camera.json " + options);
    EXPECT_EQ(result.code, 0) << options << ": " << result.err;
    last_ = result.out;
    return file_hash(folder / "out.exr");
  }

  void expect_refused(const std::string& options, const std::vector<std::string>& words) {
    expect_refusal(defray(folder, "render pinhole.exr -o none.exr --camera camera.json " + options),
                   2, words, options);
    EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
  }

  std::string last_;
  const std::string bg = "--focus-setting bg ";
};

TEST_F(ChainCommand, EveryOptionChangesThePicture) {
  std::map<std::uint64_t, std::string> seen;
  for (const std::string options : {"",
                                    "--literal",
                                    "--literal --jitter",
                                    "--half-size on",
                                    "--quality draft",
                                    "--quality high",
                                    "--rdb 20",
                                    "--rdb 20 --quality draft",
                                    "--rdb 20 --hidden patterns --quality high",
                                    "--hidden off",
                                    "--hidden fill",
                                    "--split off",
                                    "--border black",
                                    "--border renormalise",
                                    "--blades 5",
                                    "--blades 5 --blade-curvature 0.5",
                                    "--blades 5 --blade-rotation 20",
                                    "--squeeze 2",
                                    "--cats-eye 1",
                                    "--aperture-image smooth/pinhole.exr"}) {
    const auto [place, is_new] = seen.emplace(rendered(bg + options), options);
    EXPECT_TRUE(is_new) << options << " gives the picture of " << place->second;
  }
  EXPECT_NE(rendered("", "lamps"), rendered("--highlights rays", "lamps"));
  const std::string wide = bg + "--focus 0.5 --aperture-diameter 200 ";  // no circle is small
  const std::uint64_t sparse = rendered(wide);
  EXPECT_NE(last_.find("px between rows"), std::string::npos) << last_;
  EXPECT_NE(rendered(wide + "--sparse off"), sparse);
  EXPECT_EQ(last_.find("px between rows"), std::string::npos) << last_;
}

TEST_F(ChainCommand, AntialiasedDepthIsRepairedAndReported) {
  const std::uint64_t repaired = rendered(bg, "smooth");
  EXPECT_NE(last_.find("depth looks anti-aliased"), std::string::npos) << last_;
  EXPECT_NE(rendered(bg + "--repair off", "smooth"), repaired);
  EXPECT_EQ(last_.find("anti-aliased"), std::string::npos) << last_;
  EXPECT_EQ(rendered(bg), rendered(bg + "--repair off"));
}

TEST_F(ChainCommand, ConfidenceIsAChannelAndInTheSummary) {
  rendered(bg + "--confidence-out confidence.exr --json");
  const ImageFile file = ImageFile::read(folder / "confidence.exr");
  EXPECT_EQ(file.parts()[0].channels, std::vector<std::string>{"confidence"});
  double sum = 0;
  const Plane confidence = file.plane(0, 0);
  for (const float c : confidence) {
    EXPECT_GE(c, 0.0f);
    EXPECT_LE(c, 1.0f);
    sum += c;
  }
  const auto report = nlohmann::json::parse(last_)["chain"];
  EXPECT_NEAR(sum / static_cast<double>(confidence.size()), report["confidence"], 1e-3);
  EXPECT_GT(report["behind_px"], 0);
  rendered(bg);
  EXPECT_NE(last_.find("of their rays determined by the input"), std::string::npos) << last_;
}

TEST_F(ChainCommand, TilesSayWhatTheyHold) {
  rendered(bg + "--tiles-out tiles.exr --json");
  const ImageFile file = ImageFile::read(folder / "tiles.exr");
  EXPECT_EQ(file.parts()[0].channels, std::vector<std::string>{"tiles"});
  const auto tiles = nlohmann::json::parse(last_)["chain"]["tiles"];
  const Plane classes = file.plane(0, 0);
  const auto has = [&](float tile_class) {
    return std::count(classes.begin(), classes.end(), tile_class) > 0;
  };
  EXPECT_EQ(has(0), tiles["in_focus"] > 0);
  EXPECT_EQ(has(3), tiles["hidden"] > 0);
  EXPECT_TRUE(has(3));
  EXPECT_EQ(std::count(classes.begin(), classes.end(), classes[0]) % 16, 0);
  rendered(bg + "--quality preview --tiles-out preview.exr");
  EXPECT_EQ(ImageFile::read(folder / "preview.exr").plane(0, 0).size(), classes.size());
  rendered(bg + "--stats");
  for (const char* words : {"stage ", "rays ", "MiB made", "with hidden surfaces"}) {
    EXPECT_NE(last_.find(words), std::string::npos) << words << " in " << last_;
  }
  expect_refused(bg + "--stats --json", {"--stats goes without --json"});
  expect_refused(bg + "--stats --quiet", {"--stats goes without"});
}

TEST_F(ChainCommand, ReferenceGivesTheKernelsBits) {
  for (const std::string options :
       {"", "--quality preview", "--quality draft --cats-eye 0.5 --blades 6"}) {
    EXPECT_EQ(rendered(bg + options), rendered(bg + options + " --device reference")) << options;
  }
  EXPECT_EQ(rendered("--quality draft", "lamps"),
            rendered("--quality draft --device reference", "lamps"));
}

TEST_F(ChainCommand, SameBitsForEveryMemoryAndWorkGroup) {
  const std::uint64_t usual = rendered(bg);
  EXPECT_EQ(rendered(bg + "--memory 0.5"), usual);
  if (takes_long_tests()) EXPECT_EQ(rendered(bg + "--work-group 7x3"), usual);
}

TEST_F(ChainCommand, WrongUseIsSaid) {
  for (const std::string option :
       {"--quality high", "--hidden off", "--split off", "--highlights rays", "--border black",
        "--repair off", "--confidence-out c.exr", "--tiles-out t.exr", "--stats", "--half-size on",
        "--sparse off", "--blades 5", "--blade-curvature 1", "--blade-rotation 3", "--squeeze 2",
        "--aperture-image a.png", "--cats-eye 1"}) {
    const std::string name = option.substr(0, option.find(' '));
    expect_refused(bg + "--literal " + option, {name, "means nothing to --literal"});
    expect_refused(bg + "--method linear " + option, {name, "means nothing to --method linear"});
  }
  expect_refused(bg + "--method gather --literal", {"--literal", "gather"});
  expect_refused(bg + "--jitter", {"--jitter goes with --literal"});
  expect_refused(bg + "--quality best", {"--quality 'best'", "draft", "high", "normal"});
  expect_refused(bg + "--hidden of", {"--hidden 'of'", "Did you mean 'off'"});
  expect_refused(bg + "--split onn", {"--split", "Did you mean 'on'"});
  expect_refused(bg + "--highlights disc", {"--highlights", "Did you mean 'discs'"});
  expect_refused(bg + "--border mirror", {"--border", "clamp", "renormalise"});
  expect_refused(bg + "--blades 2", {"blades", "2"});
  expect_refused(bg + "--cats-eye 2", {"cats-eye", "2"});
  expect_refused(bg + "--squeeze 0", {"squeeze", "0"});
  expect_refused(bg + "--confidence-out c.png", {"c.png", ".exr"});
  expect_refused(bg + "--confidence-out none.exr", {"none.exr", "same file"});
  expect_refused(bg + "--tiles-out t.png", {"t.png", ".exr"});
  expect_refused(bg + "--tiles-out none.exr", {"none.exr", "same file"});
  expect_refused(bg + "--half-size quarter", {"--half-size", "half"});
}

}  // namespace
}  // namespace defray::test::chain_command_test
