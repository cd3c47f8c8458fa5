// Command lines that lack something, or have something too much: what is named.
#include "command/program.h"

namespace defray::test::usage_error_test {
namespace {

struct UsageErrors : testing::Test {
  UsageErrors() { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }
  void expect_refused(const std::string& command, const std::vector<std::string>& words) const {
    expect_refusal(defray(folder, command), 2, words, command);
  }
  Folder folder;
};

TEST_F(UsageErrors, AnOptionIsNoValueOfAnother) {
  const std::string render = "render in.exr -o o.exr --focal-length 50 ";
  expect_refused(render + "--focus --fstop 2",
                 {"--focus: a value is missing. Focus distance, planar, scene units"});
  expect_refused(render + "--focus --fstop=2", {"--focus: a value is missing"});
  expect_refused(render + "--fstop 2 --focus", {"--focus: a value is missing"});
  expect_refused(render + "--focus 2 --rdb -q", {"--rdb: a value is missing"});
  expect_refused("render in.exr -o --focus 2", {"--output: a value is missing"});
  expect_ok(defray(folder, render + "--focus 3 --fstop 2 --background -1 -q"));
}

TEST_F(UsageErrors, AnUnknownOptionIsNamedBeforeWhatIsMissing) {
  expect_refused("render -x.exr -o o.exr" + lens,
                 {"unknown option '-x.exr'. A file of that name is ./-x.exr. See"});
  expect_refused("render -v", {"unknown option '-v'. See 'defray render --help'"});
  expect_refused("render in.exr --outptu o.exr", {"'--outptu'. Did you mean '--output'?"});
  expect_refused("render more.exr", {"--output is missing: "});
  // As other programs call it, where there is such an option.
  expect_refused("render in.exr --focus-distance 3",
                 {"'--focus-distance'. Did you mean '--focus'?"});
  expect_refused("splat --iris-blades 5", {"unknown option '--iris-blades'. See"});
  for (const std::string name : {"anamorphic", "bit-depth", "bokeh", "f-number", "iris-blades"}) {
    expect_refused("render in.exr --" + name + " 3", {"'--" + name + "'. Did you mean '--"});
  }
}

TEST_F(UsageErrors, WhatIsMissingOrEmpty) {
  expect_refused("scene", {"name is missing: One of plate1, ", "garden", "'defray scene --help'"});
  for (const std::string place : {"render '' -o o.exr", "render in.exr -o ''"}) {
    const Result result = defray(folder, place + lens);
    expect_refusal(result, 2, {"is empty: give a value\n"}, place);
  }
}

TEST_F(UsageErrors, AnArgumentTooManyTellsWhatACommandTakes) {
  expect_refused("info in.exr b.exr",
                 {"unknown argument 'b.exr'. info takes one: file. See 'defray info --help'"});
  expect_refused("compare a.exr b.exr c.exr",
                 {"unknown argument 'c.exr'. compare takes a and b. Several pictures? A sequence "
                  "is one name with ####"});
  expect_refused("devices gpu", {"unknown argument 'gpu'. devices takes options alone."});
}

TEST_F(UsageErrors, TheWordOfAFlagFollowsAnEqualsSign) {
  expect_refused("render in.exr -o o.exr --eye display --focus 3",
                 {"unknown argument 'display'. A word of --eye follows a =: --eye=display."});
  expect_refused("render in.exr b.exr -o o.exr --eye --focus 3",
                 {"unknown argument 'b.exr'. render takes one: input. Several pictures?"});
}

TEST_F(UsageErrors, NumbersHaveNoUnits) {
  const auto refused = [&](const std::string& number, const std::vector<std::string>& words) {
    expect_refused("render in.exr -o o.exr " + number, words);
  };
  refused("--focal-length 50mm", {"--focal-length: '50mm' cannot be read as a number; write a "
                                  "number like 2.5, without a unit (mm), or 3:1,2.2:24 for"});
  refused("--fstop f/2.8", {"--fstop: 'f/2.8' cannot be", "without a unit (f-number), or"});
  refused("--focus 2m", {"'2m' cannot be", "without a unit (Focus distance, planar, scene units;"});
  refused("--focus 2,5", {"--focus: '2' has no frame; write a number like 2.5, without"});
  expect_refused(
      "psf --depth 4 --focus 3 --fstop 2 --focal-length 50mm",
      {"--focal-length: '50mm' cannot be read as a number like 2.5, without a unit. mm"});
  refused("--focus-range 2m,4m", {"--focus-range: '2m' cannot", "without a unit (scene units)"});
  refused("--unit furlong",
          {"--unit 'furlong' is not known. Allowed: m cm mm km ft in, or its length in metres\n"});
}

}  // namespace
}  // namespace defray::test::usage_error_test
