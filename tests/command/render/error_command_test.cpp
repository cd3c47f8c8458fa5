// defray render: how wrong a picture expects to be, in words, as JSON and as a picture.
#include <cmath>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::error_command_test {
namespace {

class ErrorCommand : public testing::Test {
 protected:
  Folder folder;

  void SetUp() override {
    expect_ok(defray(folder, "scene fence -o . --width 96 --height 64 --truth-samples 1"));
  }

  Result run(const std::string& options, const std::string& output = "out.exr") {
    return defray(folder, "render pinhole.exr -o " + output +
                              " --camera camera.json --focus-setting bg " + options);
  }

  nlohmann::json report(const std::string& options) {
    const Result result = run("--json " + options);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }

  void expect_refused(const std::string& options, const std::vector<std::string>& words) {
    expect_refusal(run(options, "none.exr"), 2, words, options);
    EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
  }
};

TEST_F(ErrorCommand, TheSummarySaysWhatIsExpected) {
  const Result result = run("--quality draft");
  const auto json = report("--quality draft")["expected"];
  EXPECT_NE(
      result.out.find(fmt::format("expected {:.1f} dB ({:.1f} to {:.1f}); of the error",
                                  json["psnr_srgb_db"].get<double>(), json["low_db"].get<double>(),
                                  json["high_db"].get<double>())),
      std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find(fmt::format("{:.0f} % hidden", 100 * json["hidden"].get<double>())),
            std::string::npos)
      << result.out;
  EXPECT_FALSE(json.contains("quality"));
  EXPECT_EQ(run("--literal").out.find("expected"), std::string::npos);
  EXPECT_FALSE(report("--literal").contains("expected"));
  EXPECT_GT(report("")["predict_s"], 0.0);
}

TEST_F(ErrorCommand, ThePictureHasAChannelACause) {
  const auto json = report("--error-out error.exr");
  const ImageFile file = ImageFile::read(folder / "error.exr");
  std::vector<std::string> channels = file.parts()[0].channels;
  std::sort(channels.begin(), channels.end());
  EXPECT_EQ(channels, (std::vector<std::string>{"detail", "edges", "hidden", "sampling", "total"}));
  double squares = 0;
  for (std::size_t c = 0; c < 5; ++c) {
    if (file.parts()[0].channels[c] != "total") continue;
    const Plane total = file.plane(0, static_cast<int>(c));
    for (const float e : total) squares += double{e} * e / static_cast<double>(total.size());
  }
  EXPECT_NEAR(-10 * std::log10(squares), json["expected"]["psnr_srgb_db"], 0.2);
  expect_ok(run("--quiet --error-out quiet.exr"));
  EXPECT_EQ(file_hash(folder / "quiet.exr"), file_hash(folder / "error.exr"));
}

TEST_F(ErrorCommand, AFrameANumber) {
  expect_ok(shell(folder, "cp pinhole.exr in.0001.exr; cp pinhole.exr in.0002.exr"));
  expect_ok(defray(folder,
                   "render in.####.exr -o o.####.exr --error-out e.####.exr --camera camera.json "
                   "--focus-setting bg --target-db 60"));
  EXPECT_EQ(file_hash(folder / "e.0001.exr"), file_hash(folder / "e.0002.exr"));
  const Result strict = defray(folder,
                               "render in.####.exr -o o.####.exr --camera camera.json "
                               "--focus-setting bg --target-db 60 --strict-target");
  EXPECT_EQ(strict.code, 1);
  EXPECT_NE(strict.err.find("2 of 2 frames miss --target-db 60"), std::string::npos) << strict.err;
  expect_refusal(defray(folder,
                        "render in.####.exr -o o.####.exr --error-out e.exr --camera camera.json "
                        "--focus-setting bg"),
                 2, {"e.exr", "give a name with ####"}, "one file for all");
}

TEST_F(ErrorCommand, StatsSayHowATargetsFrameIsMadeAgain) {
  expect_ok(shell(folder, "cp pinhole.exr in.0001.exr; cp pinhole.exr in.0002.exr"));
  const Result both = defray(folder,
                             "render in.####.exr -o o.####.exr --camera camera.json "
                             "--focus-setting bg --target-db 5 --stats");
  expect_ok(both);
  const std::string marker = "  the same again: defray ";
  const std::size_t at = both.out.rfind(marker);
  ASSERT_NE(at, std::string::npos) << both.out;
  const std::string again = both.out.substr(at + marker.size());
  const std::uint64_t made = file_hash(folder / "o.0002.exr");
  for (const char* name : {"o.0001.exr", "o.0002.exr"}) std::filesystem::remove(folder / name);
  expect_ok(defray(folder, again.substr(0, again.find('\n'))));
  EXPECT_EQ(file_hash(folder / "o.0002.exr"), made);
  EXPECT_FALSE(std::filesystem::exists(folder / "o.0001.exr")) << "the last frame alone";
}

/// A frame begins with what the one before took: hard, easy, easy.
TEST_F(ErrorCommand, ATargetsQualityGoesOnFromFrameToFrame) {
  const ImageFile hard = ImageFile::read(folder / "pinhole.exr");
  const Window size = hard.parts().front().data;
  const std::size_t pixels = static_cast<std::size_t>(size.width) * size.height;
  const Plane grey(pixels, 0.5f), near(pixels, 2);
  expect_ok(shell(folder, "cp pinhole.exr s.0001.exr"));
  for (const char* name : {"s.0002.exr", "s.0003.exr", "alone.exr"}) {
    ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, near}, size.width, size.height)
        .write(folder / name);
  }
  const std::string options = " --camera camera.json --focus-setting bg --target-db 60 --json";
  const auto qualities = [&](const std::string& command) {
    std::istringstream lines(defray(folder, "render " + command + options).out);
    std::vector<std::string> found;
    for (std::string line; std::getline(lines, line);) {
      found.push_back(nlohmann::json::parse(line)["expected"]["quality"]);
    }
    return found;
  };
  using Qualities = std::vector<std::string>;
  EXPECT_EQ(qualities("alone.exr -o o.exr"), Qualities{"preview"});
  EXPECT_EQ(qualities("s.####.exr -o o.####.exr"), (Qualities{"high", "high", "preview"}));
  EXPECT_EQ(qualities("s.####.exr -o o.####.exr --no-overlap"),
            (Qualities{"high", "high", "preview"}));
}

/// Of an aperture of 0, or where all is in focus: no lens can help what was sampled too little.
TEST_F(ErrorCommand, ACopyIsCalledOne) {
  const Plane noise = random_plane({32, 32}, 5), near(1024, 2);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {noise, noise, noise, near}, 32, 32)
      .write(folder / "noise.exr");
  const auto said = [&](const std::string& optics) {
    return defray(folder, "render noise.exr -o out.exr --focal-length 50 " + optics).out;
  };
  const std::string copy = "): a copy, as good as the pinhole picture is sampled\n";
  for (const std::string optics : {"--focus 3 --aperture-diameter 0", "--focus 2 --fstop 1"}) {
    const std::string text = said(optics);
    EXPECT_NE(text.find(copy), std::string::npos) << text;
    EXPECT_EQ(text.find("of the error"), std::string::npos) << text;
  }
  EXPECT_EQ(said("--focus 3 --fstop 0.2").find(copy), std::string::npos);
}

TEST_F(ErrorCommand, NothingToBeSeenIsSaidSo) {
  const Plane black(64, 0), near(64, 2);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {black, black, black, near}, 8, 8)
      .write(folder / "black.exr");
  const Result result =
      defray(folder, "render black.exr -o out.exr --focus 1 --fstop 2 --focal-length 50");
  EXPECT_NE(result.out.find("expected: no difference that a display would show"), std::string::npos)
      << result.out;
}

TEST_F(ErrorCommand, BadFramesAndMissedTargetsAreBothSaid) {
  expect_ok(shell(folder, "cp pinhole.exr b.0001.exr; echo no > b.0002.exr"));
  const Result result = defray(folder,
                               "render b.####.exr -o o.####.exr --camera camera.json "
                               "--focus-setting bg --target-db 60 --strict-target "
                               "--skip-bad-frames");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("1 of 2 frames failed"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("1 of 2 frames miss --target-db 60"), std::string::npos) << result.err;
}

TEST_F(ErrorCommand, ATargetChoosesTheQuality) {
  const auto low = report("--target-db 5")["expected"];
  EXPECT_EQ(low["quality"], "preview");
  EXPECT_EQ(low["rdb"], 6);
  EXPECT_EQ(low["misses_target"], false);
  const std::uint64_t chosen = file_hash(folder / "out.exr");
  expect_ok(run("--quality preview"));
  EXPECT_EQ(file_hash(folder / "out.exr"), chosen);
  const Result high = run("--target-db 70");
  EXPECT_EQ(high.code, 0);
  EXPECT_NE(high.out.find("--quality high --rdb 33: expected"), std::string::npos) << high.out;
  const std::size_t note = high.out.find("no quality is expected to reach 70 dB, ");
  ASSERT_NE(note, std::string::npos) << high.out;
  EXPECT_NE(high.out.find(" dB is the most: ", note), std::string::npos) << high.out;
  EXPECT_NE(high.out.find("% of the error is what was made up behind"), std::string::npos)
      << high.out;
  EXPECT_EQ(report("--target-db 70")["expected"]["misses_target"], true);
  EXPECT_EQ(run("--target-db 5 --strict-target").code, 0);
}

TEST_F(ErrorCommand, WrongUseIsSaid) {
  for (const std::string option : {"--error-out e.exr", "--target-db 40"}) {
    const std::string name = option.substr(0, option.find(' '));
    expect_refused("--literal " + option, {name, "means nothing to --literal"});
    expect_refused("--method linear " + option, {name, "means nothing to --method linear"});
  }
  expect_refused("--error-out e.png", {"e.png", ".exr"});
  expect_refused("--error-out none.exr", {"none.exr", "same file"});
  for (const std::string wrong : {"0", "-3", "91", "nan"}) {
    expect_refused("--target-db " + wrong, {"--target-db is " + wrong, "more than 0 to 90"});
  }
  for (const std::string beside :
       {"--quality draft", "--rdb 9", "--hidden fill", "--half-size on"}) {
    expect_refused("--target-db 40 " + beside, {"--target-db goes without --quality"});
  }
  for (const std::string beside :
       {"--hidden off", "--border black", "--split off", "--highlights rays", "--rdb 5"}) {
    expect_refused("--error-out e.exr " + beside,
                   {"--error-out: errors are expected of", "--border"});
    EXPECT_EQ(run(beside).out.find("expected"), std::string::npos) << beside;
  }
  expect_refused("--target-db 40 --border black", {"--target-db: errors are expected of"});
  expect_refused("--strict-target", {"--strict-target goes with --target-db"});
  expect_refused("--target 40", {"unknown option '--target'", "--target-db"});
}

}  // namespace
}  // namespace defray::test::error_command_test
