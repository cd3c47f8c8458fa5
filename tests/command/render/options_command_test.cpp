// defray render: an option that can change nothing is refused; work-groups for all kernels and one.
#include <fstream>

#include "command/program.h"

namespace defray::test::options_command_test {
namespace {

struct OptionsCommand : testing::Test {
  Folder folder;
  void SetUp() override { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }
  void expect_refused(const std::string& options, const std::vector<std::string>& words) {
    expect_refusal(defray(folder, "render in.exr -o none.exr " + options), 2, words, options);
    EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
  }
  std::uint64_t rendered(const std::string& options) {
    expect_ok(defray(folder, "render in.exr -o out.exr " + options));
    return file_hash(folder / "out.exr");
  }
};

TEST_F(OptionsCommand, WithoutHiddenSurfacesNoPixelIsSplit) {
  const std::string words = "--split means nothing to --hidden off";
  expect_refused(lens + "--hidden off --split on", {words});
  expect_refused(lens + "--hidden off --split off", {words});
}

TEST_F(OptionsCommand, QualityMustHaveSomethingLeftToSay) {
  for (const std::string hidden : {"off", "fill"}) {
    expect_refused(lens + "--quality high --rdb 5 --hidden " + hidden,
                   {"--quality means nothing beside --rdb and this --hidden"});
  }
  expect_refused(lens + "--quality preview --rdb 5 --hidden off --half-size on",
                 {"--quality means nothing beside --rdb and this --hidden"});
  EXPECT_EQ(rendered(lens + "--quality preview --rdb 5 --hidden off"),
            rendered(lens + "--rdb 5 --hidden off --half-size on"));
  // What is typed wins over the quality, wherever it stands.
  EXPECT_EQ(rendered(lens + "--quality preview --half-size off"),
            rendered(lens + "--hidden fill --rdb 6"));
  EXPECT_EQ(rendered(lens + "--hidden fill --rdb 9"), rendered(lens + "--quality draft"));
  EXPECT_EQ(rendered(lens + "--hidden fill --quality normal"),
            rendered(lens + "--quality normal --hidden fill"));
}

TEST_F(OptionsCommand, WhatGoesWithAnotherOptionNeedsIt) {
  for (const std::string option : {"--near 0", "--far 0", "--invert"}) {
    expect_refused(lens + option, {option.substr(0, option.find(' ')),
                                   "goes with --depth-kind normalized or zbuffer only"});
  }
  for (const std::string option : {"--blade-curvature 0", "--blade-rotation 0"}) {
    expect_refused(lens + option, {option.substr(0, option.find(' ')) + " goes with --blades"});
  }
  expect_refused("--eye --focus 3 --display-distance 0.6",
                 {"--display-distance goes with --eye=display"});
  expect_refused(lens + "--focus-setting a", {"--focus-setting goes with --camera FILE.json"});
  expect_refused("--camera from-metadata --focus-setting a", {"--focus-setting goes with"});
}

TEST_F(OptionsCommand, ASourceOfLensValuesMustHaveSomethingLeftToSay) {
  std::ofstream(folder / "camera.json") << R"({"focal_length_mm": 35})";
  const std::string whole = lens + "--sensor-width 36 ";
  for (const std::string camera : {"--camera camera.json", "--camera from-metadata"}) {
    expect_refused(whole + camera, {"--camera means nothing beside a focus and a whole lens"});
    expect_refused("--eye --focus 3 " + camera, {"--camera means nothing"});
  }
  expect_refused(whole + "--eye", {"--eye means nothing beside an aperture"});
  EXPECT_NE(rendered("--camera camera.json --focus 3 --fstop 0.5"), rendered(lens));
  const Result psf =
      defray(folder,
             "psf --depth 4 --focus 3 --fstop 2 --focal-length 50 --sensor-width 36 --camera "
             "camera.json");
  expect_refusal(psf, 2, {"--camera means nothing"}, "psf");
  expect_ok(defray(folder, "psf --depth 4 --focus 3 --fstop 2 --camera camera.json"));
}

TEST_F(OptionsCommand, DefaultsTypedOutAreRefusedWhereTheyMeanNothing) {
  for (const std::string option :
       {"--lens-model cg", "--depth-kind z", "--unit m", "--near 0", "--gather aware"}) {
    expect_refused("--method tiltshift " + option,
                   {option.substr(0, option.find(' ')), "means nothing to --method tiltshift"});
  }
  expect_refused(lens + "--device reference --math strict",
                 {"--math means nothing to --device reference"});
  expect_refused(lens + "--literal --hidden patterns", {"--hidden means nothing to --literal"});
}

TEST_F(OptionsCommand, WorkGroupsForOneKernelOrAllChangeNoBit) {
  const std::uint64_t base = rendered(lens);
  for (const std::string groups : {"fill=8x8,rdb_merge=32x1", "rdb_merge=16", "fill=8x8,64x1"}) {
    EXPECT_EQ(rendered(lens + "--work-group " + groups), base) << groups;
  }
}

// PoCL keeps work-items' variables on its threads' stacks.
TEST_F(OptionsCommand, TheLargestWorkGroupChangesNoBit) {
  SKIP_UNLESS_FULL();
  const std::size_t most = device_under_test().max_work_group;
  const std::uint64_t base = rendered(lens);
  EXPECT_EQ(rendered(lens + "--work-group " + std::to_string(most)), base);
  EXPECT_EQ(rendered(fmt::format("{}--work-group {}x4", lens, most / 4)), base);
}

TEST_F(OptionsCommand, WrongWorkGroupsAreRefused) {
  const auto refused = [&](const std::string& groups, const std::vector<std::string>& words) {
    expect_refused(lens + "--work-group " + groups, words);
  };
  for (const std::string groups : {"fill=", "fill=0x1", "8x8x8", "64,", "=8", "fill=8;coc=8"}) {
    refused("'" + groups + "'", {"--work-group '" + groups + "'", "64x1", "fill=8x8"});
  }
  refused("64,32", {"that of all kernels for the second time"});
  refused("fill=8,fill=9", {"says fill for the second time"});
  refused("fil=8x8",
          {"--work-group: kernel 'fil' is not known. Did you mean 'fill'? Allowed: ", "rdb_merge"});
  refused("fill=4096x4096", {"work-group 4096x4096", "allows at most"});
}

TEST_F(OptionsCommand, HelpTellsDefaultsAndMethodsByTheRows) {
  const std::string help = defray(folder, "render --help").out;
  for (const std::string words :
       {"1 to 1024 (gather); default 32", "MiB for buffers; default 512", "default 0.5",
        "Lens (not tiltshift):", "preview|draft|normal|high", "--rdb 33 --hidden patterns"}) {
    EXPECT_NE(help.find(words), std::string::npos) << words << "\n" << help;
  }
}

}  // namespace
}  // namespace defray::test::options_command_test
