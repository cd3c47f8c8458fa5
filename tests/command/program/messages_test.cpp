// Errors that other tests meet by the way: what they say.
#include <fstream>

#include "command/program.h"

namespace defray::test::messages_test {
namespace {

class Messages : public testing::Test {
 protected:
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(defray(folder_, arguments), code, words, arguments);
  }
  Folder folder_;
  const std::string lens = " --focus 3 --fstop 2 --focal-length 50 -o o.exr ";
};

TEST_F(Messages, OfAnAperture) {
  write_picture_file(folder_, "in.exr", {"R", "G", "B", "Z"});
  expect_refused("render in.exr --blades 5 --aperture-image in.exr" + lens, 2,
                 {"--aperture-image and --blades: choose one shape"});
}

TEST_F(Messages, OfACameraFile) {
  write_picture_file(folder_, "in.exr", {"R", "G", "B", "Z"});
  std::ofstream(folder_ / "camera.json")
      << R"({"focal_length_mm": 50, "focus_settings": {"a": {"focus_distance_m": 3, "f_stop": 2},)"
      << R"( "b": {"focus_distance_m": 4, "f_stop": 2}}})";
  expect_refused("render in.exr -o o.exr --camera camera.json", 3,
                 {"camera.json: has several focus settings: a b; choose with --focus-setting"});
  std::ofstream(folder_ / "none.json") << R"({"focal_length_mm": 50, "f_stop": 2})";
  expect_refused("render in.exr -o o.exr --focus 3 --camera none.json --focus-setting a", 3,
                 {"none.json: no focus setting 'a': it has none; leave --focus-setting out"});
}

TEST_F(Messages, OfChannelsThatCouldBeMeant) {
  write_picture_file(folder_, "two.exr", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B", "Z"});
  expect_refused("render two.exr" + lens, 3,
                 {"two.exr: colour could be", "choose with --layer or --view"});
}

TEST_F(Messages, OfNumbersAndWords) {
  write_picture_file(folder_, "in.exr", {"R", "G", "B", "Z"});
  expect_refused("render in.exr --background far" + lens, 2,
                 {"--background 'far' is neither a number nor none"});
  expect_refused("validate --kernel coc -o v --case 64,ties", 2, {"--case: '64' is not valid"});
  expect_refused(
      "validate --kernel coc -o v --case 8x8,tise", 2,
      {"--case: 'tise' is not known. Did you mean 'ties'? Allowed: WIDTHxHEIGHT jitter"});
  expect_refused("validate --kernel rdb_mrege -o v", 2,
                 {"--kernel 'rdb_mrege' is not known. Did you mean 'rdb_merge'? Allowed: "});
  expect_refused("tune --kernel fil", 2,
                 {"--kernel 'fil' is not known. Did you mean 'fill'? Allowed: "});
  expect_refused("scene plat1 -o .", 2,
                 {"scene 'plat1' is not known. Did you mean 'plate1'? Allowed: plate1 plate2"});
  expect_refused("validate --kernel coc -o v --case 8x8,ties,group=4", 2,
                 {"--case: 'group=4' is not valid: write two numbers as 64x48"});
}

TEST_F(Messages, OfATextCloud) {
  std::ofstream(folder_ / "five.xyz") << "0 0 0 1 2\n1 0 0 1 2\n";
  expect_refused("splat five.xyz" + lens, 3,
                 {"five.xyz: has 5 columns", "3, 6, 9 or, with an intensity"});
  expect_refused("splat --model plane --model-points 99 --fstop 2 --fov 180 -o o.exr", 2,
                 {"--fov is 180 degrees", "below 180"});
  std::ofstream(folder_ / "scan.pts") << "3\n0 0 0 -12 255 0 0\n1 0 0 8 255 9 9\n0 1 0 3 255 2 2\n";
  const Result scan = defray(folder_, "splat scan.pts -o o.exr --fstop 2 --size 16x16 --json");
  expect_ok(scan);
  EXPECT_EQ(scan.err, "defray: note: scan.pts: not used: intensity\n");
  std::ofstream(folder_ / "half.xyz") << "x y z red radius f_dc\n0 0 0 1 1 4\n1 0 0 1 1 4\n";
  EXPECT_EQ(defray(folder_, "splat half.xyz -o o.exr --fstop 2 --size 16x16 --json").err,
            "defray: note: half.xyz: not used: red f_dc\n");
}

}  // namespace
}  // namespace defray::test::messages_test
