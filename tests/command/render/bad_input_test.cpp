// Bad input from the command line: each gives one clear line and its documented exit code.
#include <cmath>
#include <fstream>

#include "command/program.h"

namespace defray::test::bad_input_test {
namespace {

class BadInput : public testing::Test {
 protected:
  BadInput() {
    write_picture_file(folder_, "in.exr", {"R", "G", "B", "Z"});
    write_picture_file(folder_, "small.exr", {"R", "G", "B", "Z"}, {20, 10});
    write_picture_file(folder_, "flat.exr", {"R", "G", "B"});
    write_picture_file(folder_, "normals.exr", {"R", "G", "B", "N.X", "N.Y", "N.Z"});
    write_picture_file(folder_, "two.exr", {"R", "G", "B", "depth.Z", "zdepth.Z"});
    write_picture_file(folder_, "depth.exr", {"Z"});
  }

  void expect_render_refused(const std::string& arguments, int code,
                             const std::vector<std::string>& words) {
    const std::string command = "render " + arguments;
    expect_refusal(defray(folder_, command), code, words, command);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.exr")) << command;
  }

  Folder folder_;
};

TEST_F(BadInput, Files) {
  expect_render_refused("none.exr -o out.exr" + lens, 3, {"none.exr", "no such file"});
  expect_render_refused(". -o out.exr" + lens, 3, {"is a folder"});
  expect_render_refused("'in.*.exr' -o out.exr" + lens, 3, {"in.*.exr: no such file; #### stands"});
  std::ofstream(folder_ / "text.exr") << "not an image";
  expect_render_refused("text.exr -o out.exr" + lens, 3, {"text.exr", "not a readable image"});
  std::ofstream(folder_ / "text.png") << "not an image";
  expect_render_refused("text.png -o out.exr" + lens, 3, {"text.png", "not a readable image"});
  shell(folder_, "head -c 3000 in.exr >cut.exr");
  expect_render_refused("cut.exr -o out.exr" + lens, 3, {"cut.exr"});
  expect_render_refused("in.exr --depth none.exr -o out.exr" + lens, 3, {"none.exr"});
}

TEST_F(BadInput, Channels) {
  expect_render_refused("flat.exr -o out.exr" + lens, 3, {"flat.exr", "no depth", "--depth"});
  expect_render_refused("normals.exr -o out.exr" + lens, 3, {"no depth", "N.Z"});
  expect_render_refused(
      "depth.exr -o out.exr" + lens, 3,
      {"no colour", "Give a file that has them, or Y alone for grey. It has: Z\n"});
  expect_render_refused("two.exr -o out.exr" + lens, 3, {"depth.Z, zdepth.Z", "--depth-channel"});
  expect_render_refused(
      "in.exr -o out.exr --layer beauty" + lens, 3,
      {"no colour in layer 'beauty'; there is some in no layer. Leave --layer out\n"});
  expect_render_refused("in.exr -o out.exr --view left" + lens, 3,
                        {"no colour in view 'left'; ", "Leave --view out\n"});
  expect_render_refused("in.exr -o out.exr --depth-channel z" + lens, 3, {"'z'", "'Z'"});
  expect_render_refused("in.exr --depth small.exr -o out.exr" + lens, 3,
                        {"20x10+0+0", "48x32+0+0", "depth of another picture?"});
}

TEST_F(BadInput, DepthValues) {
  Plane z(1536, 3.0f);
  z[49] = -2;
  const Plane grey(1536, 0.5f);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, z}, 48, 32)
      .write(folder_ / "negative.exr");
  expect_render_refused("negative.exr -o out.exr --background none" + lens, 3,
                        {"depth -2", "(1, 1)", "--background -2"});
  const Result background = defray(folder_, "render negative.exr -o ok.exr" + lens);
  EXPECT_EQ(background.code, 0);
  EXPECT_NE(background.out.find("background 1 px"), std::string::npos) << background.out;
  EXPECT_EQ(defray(folder_, "render negative.exr -o ok.exr --background -2" + lens).code, 0);
  z[49] = 0;
  z[50] = NAN;
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, z}, 48, 32)
      .write(folder_ / "nan.exr");
  expect_render_refused("nan.exr -o out.exr --background none" + lens, 3, {"depth 0"});
  const Result nan = defray(folder_, "render nan.exr -o ok.exr" + lens);
  EXPECT_EQ(nan.code, 0);
  EXPECT_NE(nan.out.find("background 2 px (1 of them NaN)"), std::string::npos) << nan.out;
}

TEST_F(BadInput, Lens) {
  const std::string files = "in.exr -o out.exr ";
  expect_render_refused(files, 2, {"--focus, --focal-length, --fstop"});
  expect_render_refused(files + "--focus 3 --fstop 0 --focal-length 50", 2, {"f-number is 0"});
  expect_render_refused(files + "--focus 3 --fstop -2 --focal-length 50", 2, {"f-number is -2"});
  expect_render_refused(files + "--focus 3 --fstop 2 --focal-length 0", 2, {"focal length is 0"});
  expect_render_refused(files + "--focus 3 --fstop nan --focal-length 50", 2, {"f-number is nan"});
  expect_render_refused(files + "--focus 0 --fstop 2 --focal-length 50", 2,
                        {"focus distance is 0"});
  expect_render_refused(files + "--focus 0.05 --fstop 2 --focal-length 50", 2,
                        {"inside the focal length"});
  expect_render_refused(files + "--focus 3 --aperture-diameter -1 --focal-length 50", 2,
                        {"aperture diameter is -1"});
  expect_render_refused(files + lens + "--aperture-diameter 5", 2, {"one of them"});
  expect_render_refused(files + lens + "--sensor-width 0", 2, {"sensor width is 0"});
  expect_render_refused(files + lens + "--max-coc 0", 2, {"--max-coc is 0"});
  expect_render_refused(files + "--camera none.json", 3, {"none.json"});
  expect_render_refused(files + lens + "--focus-setting a", 2, {"--camera"});
}

TEST_F(BadInput, OptionValues) {
  const std::string base = "in.exr -o out.exr " + lens;
  expect_render_refused(base + "--rdb 0", 2, {"--rdb is 0", "1 to 64"});
  expect_render_refused(base + "--rdb 65", 2, {"--rdb is 65"});
  expect_render_refused(base + "--rdb x", 2, {"--rdb"});
  for (const std::string option : {"--rdb", "--cats-eye", "--quality", "--coc-out", "--device"}) {
    expect_render_refused(base + option + " ''", 2, {option + " is empty", "leave the option out"});
  }
  expect_render_refused(base + "--cats-eye=", 2, {"--cats-eye"});
  expect_render_refused(base + "--cats-eye abc", 2,
                        {"--cats-eye: 'abc' cannot be read as a number"});
  expect_render_refused(base + "--rdb 1.5", 2, {"'1.5' cannot be read as a whole number", "64"});
  expect_render_refused(base + "--literal=x", 2, {"--literal", "'x'", "as true or false"});
  expect_render_refused(base + "--hidden", 2, {"--hidden: a value is missing", "patterns"});
  expect_render_refused(base + "--blades 5 --blades 6", 2,
                        {"--blades: it is given more than once", "3 to 32"});
  expect_render_refused(base + "--method rbd", 2, {"'rbd'", "Did you mean 'rdb'?"});
  expect_render_refused(base + "--depth-kind distnace", 2, {"Did you mean 'distance'?"});
  expect_render_refused(base + "--nonfinite zreo", 2, {"Did you mean 'zero'?"});
  expect_render_refused(base + "--lens-model gc", 2, {"cg"});
  expect_render_refused(base + "--unit furlong", 2, {"'furlong'", "cm"});
  for (const std::string unit : {"0", "-1", "inf", "nan"}) {
    expect_render_refused(base + "--unit=" + unit, 2, {"scene unit is " + unit});
  }
  for (const std::string bad : {"nan", "+-1"}) {
    expect_render_refused(base + "--background " + bad, 2, {"'" + bad + "'"});
  }
  expect_render_refused(base + "--background blue", 2, {"'blue'"});
  expect_render_refused(base + "--memory 0", 2, {"--memory is 0"});
  expect_render_refused(base + "--rays scatter --memory 0.001", 2,
                        {"--memory is 0.0009995 MiB", "one row", "at least"});
  expect_render_refused(base + "--work-group 0x4", 2, {"'0x4'", "64x1"});
  expect_render_refused(base + "--work-group 99999x99", 2, {"at most"});
  expect_render_refused(base + "--device nonesuch", 5, {"'nonesuch'", "reference"});
  // A number is no part of a name, such as avx512.
  expect_render_refused(base + "--device 512", 5, {"no OpenCL device 512", "found: 0: "});
  expect_render_refused(base + "--invert", 2, {"--invert", "normalized"});
  expect_render_refused(base + "--depth-kind normalized", 2, {"needs --near"});
  expect_render_refused(base + "--depth-kind normalized --near 3 --far 2", 2, {"--near < --far"});
  expect_render_refused(base + "--frames 1-3", 2, {"--frames needs a pattern"});
}

TEST_F(BadInput, Frames) {
  write_picture_file(folder_, "s.0001.exr", {"R", "G", "B", "Z"});
  write_picture_file(folder_, "s.0002.exr", {"R", "G", "B", "Z"});
  for (const std::string frames : {"1-", "a", "1-2x0", "1,,2"}) {
    expect_render_refused("s.%04d.exr -o o.%04d.exr --frames " + frames + lens, 2, {"--frames"});
  }
  expect_render_refused("s.%04d.exr -o o.%04d.exr --frames ''" + lens, 2, {"--frames is empty"});
  expect_render_refused("s.%04d.exr -o o.%04d.exr --frames 1-9999999999" + lens, 2,
                        {"'1-9999999999'", "up to 999999999"});
  expect_render_refused("s.%04d.exr -o out.exr" + lens, 2,
                        {"2 frames would go to one file; give a name with ####", "--frames 1"});
  expect_render_refused("t.%04d.exr -o o.%04d.exr" + lens, 3, {"no file matches"});
  expect_render_refused("in.exr -o o.####.exr" + lens, 2, {"the input in.exr has none"});
  expect_render_refused("s.%04d.exr -o o_%04d.####.exr" + lens, 2, {"2 frame patterns"});
}

TEST_F(BadInput, Outputs) {
  expect_render_refused("in.exr -o none/out.exr" + lens, 4, {"none", "cannot write in folder"});
  expect_render_refused("in.exr -o in.exr" + lens, 2, {"input and output at once"});
  expect_render_refused("in.exr -o ./in.exr" + lens, 2, {"input and output at once"});
  shell(folder_, "cp small.exr bokeh.exr");
  expect_render_refused("in.exr -o bokeh.exr --aperture-image bokeh.exr" + lens, 2,
                        {"bokeh.exr: is input and output at once"});
  std::ofstream(folder_ / "camera.exr")
      << R"({"focal_length_mm": 50, "focus_distance_m": 3, "f_stop": 2})";
  expect_render_refused("in.exr -o camera.exr --camera camera.exr", 2,
                        {"camera.exr: is input and output at once"});
  expect_render_refused("in.exr -o small.exr --depth small.exr" + lens, 2, {"at once"});
  expect_render_refused("in.exr -o out.exr --coc-out out.exr" + lens, 2, {"the same file"});
  expect_render_refused("in.exr -o out.xyz" + lens, 2, {"'.xyz'", ".exr"});
  expect_render_refused("in.exr -o out" + lens, 2, {"out: has no extension", ".exr"});
  expect_render_refused("in.exr -o ." + lens, 2, {"is a folder", ".exr"});
  const Result full = defray(folder_, "devices >/dev/full");
  EXPECT_EQ(full.code, 4) << full.err;
}

TEST_F(BadInput, Spelling) {
  const auto refused = [&](const std::string& command, const std::vector<std::string>& words) {
    expect_refusal(defray(folder_, command), 2, words, command);
  };
  refused("rendr", {"unknown command 'rendr'", "Did you mean 'render'?"});
  refused("render in.exr -o out.exr --focsu 3", {"'--focsu'", "Did you mean '--focus'?"});
  refused("render in.exr -o out.exr --fstpo=3", {"'--fstpo'", "Did you mean '--fstop'?"});
  refused("render in.exr -o out.exr --foc 3", {"'--foc'. There are --focus, --focal-length, "});
  refused("render in.exr -o out.exr --hidde off", {"'--hidde'. Did you mean '--hidden'?"});
  refused("render in.exr more.exr -o out.exr", {"unknown argument 'more.exr'"});
  refused("render -o out.exr", {"input"});
  refused("scene plat1 -o .", {"Did you mean 'plate1'?"});
  refused("scene plate1 -o . --truth-samples 0", {"--truth-samples is 0"});
  refused("scene plate1 -o . --width 0", {"scene size"});
  refused("sheet in.exr -o s.png --captions a,b", {"--captions"});
  refused("sheet in.exr -o s.exr", {"PNG or JPEG"});
  EXPECT_EQ(defray(folder_, "sheet in.exr -o s.png").code, 0);
  refused("sheet s.png -o s.png", {"input and output at once"});
  refused("render in.exr -o out.exr --depth ''" + lens, {"--depth", "is empty"});
}

TEST_F(BadInput, Compare) {
  const std::string command = "compare in.exr small.exr";
  expect_refusal(defray(folder_, command), 3, {"48x32", "20x10"}, command);
  EXPECT_EQ(defray(folder_, "compare in.exr in.exr --min-psnr 99").code, 0);
  EXPECT_EQ(defray(folder_, "compare in.exr in.exr --min-psnr nan").code, 2);
  const Plane bad(1536, NAN);
  ImageFile::from_planes({"R", "G", "B"}, {bad, bad, bad}, 48, 32).write(folder_ / "bad.exr");
  EXPECT_EQ(defray(folder_, "compare in.exr bad.exr --min-psnr 1").code, 1);
  EXPECT_EQ(defray(folder_, "compare in.exr flat.exr --min-psnr 99").code, 0);
  write_picture_file(folder_, "other.exr", {"x.R", "R", "G", "B"});
  EXPECT_EQ(defray(folder_, "compare in.exr other.exr --min-psnr 99").code, 1);
}

TEST_F(BadInput, DeepImages) {
  SKIP_WITHOUT_SHARED();
  expect_render_refused("'" + shared_folder() + "/images/deep/Balls.exr' -o out.exr" + lens, 3,
                        {"deep image", "flatten"});
}

TEST_F(BadInput, SharedNonfiniteImagesHaveNoDepthOrColour) {
  SKIP_WITHOUT_SHARED();
  const std::string images = "'" + shared_folder() + "/images/nonfinite/";
  expect_render_refused(images + "AllHalfValues.exr' -o out.exr" + lens, 3, {"no depth"});
  expect_render_refused(images + "WideFloatRange.exr' -o out.exr" + lens, 3, {"no colour"});
}

TEST_F(BadInput, SharedDamagedFilesEndWithOneLineEach) {
  SKIP_WITHOUT_SHARED();
  for (const auto& entry :
       std::filesystem::directory_iterator(shared_folder() + "/images/damaged")) {
    expect_render_refused("'" + entry.path().string() + "' -o out.exr --device reference" + lens, 3,
                          {entry.path().filename().string()});
  }
}

}  // namespace
}  // namespace defray::test::bad_input_test
