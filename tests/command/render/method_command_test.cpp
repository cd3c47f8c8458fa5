// defray render --method: every option changes the picture, every wrong use is said.
#include <cmath>

#include "command/program.h"

namespace defray::test::method_command_test {
namespace {

std::uint64_t rendered(const Folder& folder, const std::string& options) {
  const Result result = defray(folder, "render in.exr -o out.exr " + options);
  EXPECT_EQ(result.code, 0) << options << ": " << result.err;
  return file_hash(folder / "out.exr");
}

struct Picture : testing::Test {
  Folder folder;
  void SetUp() override { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }
  void expect_refused(const std::string& options, const std::vector<std::string>& words) {
    expect_refusal(defray(folder, "render in.exr -o none.exr " + options), 2, words, options);
    EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
  }
};

using MethodCommand = Picture;

TEST_F(MethodCommand, MethodsAndTheirOptionsChangeThePicture) {
  std::map<std::uint64_t, std::string> seen;
  const auto expect_new = [&](const std::string& options) {
    const auto [place, is_new] = seen.emplace(rendered(folder, options), options);
    EXPECT_TRUE(is_new) << options << " gives the picture of " << place->second;
  };
  for (const std::string options :
       {"", "--rdb 5", "--literal", "--literal --jitter", "--literal --jitter --seed 3",
        "--method linear", "--method gather", "--method gather --samples 8",
        "--method gather --passes 1", "--method gather --rotate", "--method gather --seed 3",
        "--method gather --gather literal"}) {
    expect_new(lens + options);
  }
  expect_new("--method tiltshift");
  expect_new("--method tiltshift --band-centre 0.2");
  expect_new("--method tiltshift --band-width 0.5");
  expect_new("--method tiltshift --max-blur 4");
}

TEST_F(MethodCommand, RaysGiveOnePictureHoweverTheyAreFollowed) {
  const std::string both = lens + "--rdb 5 ";
  for (const std::string more : {"", "--literal ", "--literal --jitter "}) {
    EXPECT_EQ(rendered(folder, both + more + "--rays gather"),
              rendered(folder, both + more + "--rays scatter"))
        << more;
  }
  expect_refused(lens + "--rays shoot", {"--rays", "'shoot'", "gather", "scatter"});
  expect_refused(lens + "--method linear --rays gather", {"--rays", "rdb"});
}

TEST_F(MethodCommand, ReferenceGivesTheKernelsBits) {
  for (const std::string options :
       {"--method linear", "--method gather --rotate", "--method gather --gather literal"}) {
    EXPECT_EQ(rendered(folder, lens + options),
              rendered(folder, lens + options + " --device reference"))
        << options;
  }
  EXPECT_EQ(rendered(folder, "--method tiltshift"),
            rendered(folder, "--method tiltshift --device reference"));
}

TEST_F(MethodCommand, FastArithmeticRunsAndSaysSo) {
  for (const std::string method : {"linear", "gather --gather literal", "gather", "rdb"}) {
    if (method == "rdb" && !takes_long_tests()) break;  // seconds of compiling
    const std::string options = lens + "--method " + method;
    rendered(folder, options);
    const Plane strict = ImageFile::read(folder / "out.exr").plane(0, 0);
    const Result result = defray(folder, "render in.exr -o out.exr --math fast " + options);
    expect_ok(result);
    EXPECT_NE(result.out.find("(fast arithmetic)"), std::string::npos) << result.out;
    const Plane fast = ImageFile::read(folder / "out.exr").plane(0, 0);
    double squares = 0;
    for (std::size_t i = 0; i < strict.size(); ++i) {
      squares += (fast[i] - strict[i]) * (fast[i] - strict[i]);
    }
    // A ray on a pixel's border may go the other way: single pixels differ.
    EXPECT_LT(std::sqrt(squares / static_cast<double>(strict.size())), 0.02) << method;
  }
  EXPECT_EQ(rendered(folder, lens + "--math strict"), rendered(folder, lens));
  EXPECT_EQ(defray(folder, "render in.exr -o out.exr " + lens).out.find("arithmetic"),
            std::string::npos);
}

TEST_F(MethodCommand, ReferenceRefusesWhatOnlyKernelsHave) {
  expect_refused(lens + "--math fats", {"--math", "fats", "Did you mean 'fast'"});
  const std::string reference = lens + "--device reference ";
  expect_refused(reference + "--math fast", {"--math", "means nothing to --device reference"});
  expect_refused(reference + "--work-group 8x8", {"--work-group", "--device reference"});
  expect_refused(reference + "--memory 64", {"--memory", "--device reference"});
}

TEST_F(MethodCommand, TiltshiftNeedsNeitherDepthNorLens) {
  write_picture_file(folder, "flat.exr", {"R", "G", "B"});
  const Result result =
      defray(folder, "render flat.exr -o out.exr --method tiltshift --coc-out coc.exr");
  expect_ok(result);
  EXPECT_NE(result.out.find("no depth"), std::string::npos) << result.out;
  const Plane coc = ImageFile::read(folder / "coc.exr").plane(0, 0);
  EXPECT_EQ(coc[16 * 48], 0);
  EXPECT_NEAR(coc[0], 9.2 * (1 - 0.5 / (0.4 * 32)), 1.0 / 256);
}

TEST_F(MethodCommand, NoBlurReturnsTheInputBitForBit) {
  const std::uint64_t input = file_hash(folder / "in.exr");
  EXPECT_EQ(rendered(folder, "--method tiltshift --max-blur 0"), input);
  for (const std::string method : {"rdb", "linear", "gather", "gather --gather literal"}) {
    EXPECT_EQ(
        rendered(folder, "--focus 3 --aperture-diameter 0 --focal-length 50 --method " + method),
        input)
        << method;
  }
}

TEST_F(MethodCommand, EyeAndPerceivedScale) {
  const std::string eye = "--eye --focus 5 ";
  const std::uint64_t plain = rendered(folder, eye + "--scale 0.002");
  EXPECT_NE(plain, rendered(folder, eye));
  EXPECT_EQ(plain, rendered(folder, eye + "--perceived-distance 0.01"));
  EXPECT_EQ(plain, rendered(folder,
                            "--aperture-diameter 2300 --focal-length 17 --focus 5 "
                            "--pixel-scale 28000"));
  EXPECT_NE(plain, rendered(folder, eye + "--scale 0.002 --pixel-scale 14000"));
  const std::string display = "--eye=display --focus 5 --scale 0.002 ";
  const std::uint64_t shown = rendered(folder, display);
  EXPECT_NE(shown, plain);
  EXPECT_NE(shown, rendered(folder, display + "--display-distance 0.3"));
  EXPECT_NE(shown, rendered(folder, display + "--display-resolution 2000"));
}

TEST_F(MethodCommand, RefusesOptionsOfOtherMethods) {
  expect_refused(lens + "--method gathr", {"gathr", "Did you mean 'gather'", "linear"});
  expect_refused(lens + "--samples 8", {"--samples", "--method rdb", "gather"});
  expect_refused(lens + "--method linear --rotate", {"--rotate", "gather"});
  expect_refused(lens + "--method gather --rdb 9", {"--rdb", "rdb"});
  expect_refused(lens + "--seed 3", {"--seed", "--jitter"});
  expect_refused(lens + "--max-blur 3", {"--max-blur", "tiltshift"});
  expect_refused("--method tiltshift --focus 3", {"--focus", "rdb, linear, gather"});
}

TEST_F(MethodCommand, RefusesWhatTheMethodWouldIgnore) {
  for (const std::string option :
       {"--unit cm", "--depth-kind inverse", "--near 1", "--far 2", "--invert", "--background 0",
        "--lens-model breathing", "--focus-setting x", "--display-distance 1",
        "--display-resolution 9", "--depth in.exr", "--camera none.json", "--eye", "--max-coc 3"}) {
    expect_refused("--method tiltshift " + option,
                   {option.substr(0, option.find(' ')), "means nothing"});
  }
}

TEST_F(MethodCommand, MemoryChangesNoPicture) {
  for (const auto& options :
       {lens + "--method linear", lens + "--method gather", std::string("--method tiltshift")}) {
    EXPECT_EQ(rendered(folder, options + " --memory 0.1"), rendered(folder, options)) << options;
  }
}

TEST_F(MethodCommand, RefusesOneFileForTwoOutputsHoweverSpelt) {
  expect_refused(lens + "--coc-out ./none.exr", {"-o and --coc-out", "same file"});
}

TEST_F(MethodCommand, ReportsSayWhatRan) {
  const Result tiltshift = defray(folder, "render in.exr -o out.exr --json --method tiltshift");
  EXPECT_NE(tiltshift.out.find("\"method\":\"tiltshift\""), std::string::npos) << tiltshift.out;
  EXPECT_EQ(tiltshift.out.find("focal_length"), std::string::npos) << tiltshift.out;
  const Result eye = defray(folder, "render in.exr -o out.exr --json --eye --focus 3");
  EXPECT_NE(eye.out.find("\"pixels_per_metre\":28000"), std::string::npos) << eye.out;
  EXPECT_EQ(eye.out.find("sensor"), std::string::npos) << eye.out;
  EXPECT_NE(defray(folder, "render in.exr -o out.exr --eye --focus 3").out.find("28000 px/m"),
            std::string::npos);
}

TEST_F(MethodCommand, RayDistancesNeedAFieldOfView) {
  const Result result =
      defray(folder, "render in.exr -o none.exr --depth-kind distance --eye --focus 3");
  expect_refusal(result, 2, {"--depth-kind distance", "field of view"}, "distance");
}

TEST_F(MethodCommand, RefusesValuesOutOfRange) {
  expect_refused(lens + "--method gather --samples 0", {"--samples is 0", "1 to 1024"});
  expect_refused(lens + "--method gather --samples 100000", {"100000", "1 to 1024"});
  expect_refused(lens + "--method gather --passes 0", {"--passes is 0", "1 to 8"});
  expect_refused(lens + "--method gather --gather litral", {"litral", "Did you mean 'literal'"});
  expect_refused("--method tiltshift --band-centre 1.5", {"--band-centre is 1.5", "0 (top)"});
  expect_refused("--method tiltshift --band-width -1", {"--band-width is -1"});
  expect_refused("--method tiltshift --max-blur 5000", {"--max-blur is 5000", "1024"});
  expect_refused(lens + "--method linear --memory 0.001", {"--memory", "MiB"});
  expect_refused("--focus 3 --aperture-diameter 5e6 --focal-length 50 --method linear",
                 {"linear filtering takes 1024 px", "--max-coc"});
}

TEST_F(MethodCommand, RefusesContradictingLenses) {
  expect_refused("--eye=retna --focus 5", {"retna", "Did you mean 'retina'"});
  expect_refused("--eye --focus 5 --display-distance 0.5", {"--display-distance", "--eye=display"});
  expect_refused("--eye=display --focus 5 --display-distance 0", {"above 0"});
  expect_refused("--eye --focus -3 --perceived-distance 1", {"focus distance is -3"});
  expect_refused("--eye --focus 5 --scale 0", {"--scale 0", "perceived scale 0"});
  expect_refused("--eye --focus 5 --scale 1 --perceived-distance 1", {"--scale", "one of them"});
  expect_refused("--eye --focus inf --perceived-distance 1", {"finite --focus"});
  expect_refused(lens + "--sensor-width 36 --pixel-scale 28000", {"--pixel-scale", "one of them"});
  expect_refused(lens + "--pixel-scale 0", {"--pixel-scale"});
}

}  // namespace
}  // namespace defray::test::method_command_test
