// How 'defray render' stores what it writes.
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <fstream>

#include "command/program.h"
#include "image/image_file.h"

namespace defray::test::output_command_test {
namespace {

class OutputCommand : public testing::Test {
 protected:
  OutputCommand() {
    write_picture_file(folder_, "in.exr", {"R", "G", "B", "Z"});
    expect_ok(defray(folder_, "render in.exr -o zip.exr --compression zip" + lens));
  }

  std::string compression_of(const std::string& file) const {
    return OIIO::ImageInput::open(folder_ / file)->spec().get_string_attribute("compression");
  }

  Folder folder_;
};

TEST_F(OutputCommand, IsCompressedAsAsked) {
  EXPECT_EQ(compression_of("zip.exr"), "zip");
  expect_ok(defray(folder_, "render zip.exr -o same.exr" + lens));
  EXPECT_EQ(compression_of("same.exr"), "zip");
  const Plane red = ImageFile::read(folder_ / "same.exr").plane(0, 0);
  expect_ok(
      defray(folder_, "render zip.exr -o rle.exr --compression rle --coc-out coc.exr" + lens));
  EXPECT_EQ(compression_of("rle.exr"), "rle");
  EXPECT_EQ(compression_of("coc.exr"), "rle");
  EXPECT_EQ(ImageFile::read(folder_ / "rle.exr").plane(0, 0), red);
  expect_ok(defray(folder_, "render zip.exr -o lzw.tif --compression lzw" + lens));
  EXPECT_EQ(compression_of("lzw.tif"), "lzw");
  expect_ok(defray(folder_, "render in.exr -o o.png --coc-out c.exr --compression none" + lens));
  EXPECT_EQ(compression_of("c.exr"), "none");
  const Result lossy = defray(folder_, "render zip.exr -o p.exr --compression pxr24" + lens);
  expect_ok(lossy);
  EXPECT_NE(lossy.out.find("compression is lossy"), std::string::npos) << lossy.out;
}

TEST_F(OutputCommand, RefusesWhatAFormatHasNot) {
  const auto refuse = [&](const std::string& options, const std::vector<std::string>& words) {
    const std::string command = "render in.exr -o " + options + lens;
    expect_refusal(defray(folder_, command), 2, words, command);
  };
  refuse("o.exr --compression rlee", {"o.exr: --compression 'rlee' is not known.",
                                      "Did you mean 'rle'?", "Allowed: none rle zips zip piz"});
  refuse("o.tif --compression piz",
         {"o.tif: --compression 'piz' is not known", "Allowed: none lzw zip packbits"});
  refuse("o.exr --coc-out c.tif --compression piz", {"c.tif: --compression 'piz' is not known"});
  refuse("o.png --compression zip", {"--compression goes with .exr and .tif, not with o.png"});
}

TEST(WriteProtected, OutputsOfEveryCommandStay) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  namespace fs = std::filesystem;
  const auto expect_kept = [&](const std::string& name, const std::string& command) {
    fs::create_directories(fs::path(folder / name).parent_path());
    std::ofstream(folder / name) << "old";
    fs::permissions(folder / name, fs::perms(0444));
    expect_refusal(defray(folder, command), 4, {name + ": is write-protected; allow writing it"},
                   command);
    EXPECT_EQ(fs::file_size(folder / name), 3U) << command;
    fs::remove(folder / name);
  };
  const std::string render = "render in.exr -o o.exr -q" + lens;
  expect_kept("o.exr", render);
  expect_kept("o.exr", render + "--mkdir");
  expect_kept("coc.exr", render + "--coc-out coc.exr");
  EXPECT_FALSE(fs::exists(folder / "o.exr"));
  expect_kept("o.png", "splat --model plane --model-points 99 -o o.png --fstop 2 --size 16x16");
  expect_kept("s.png", "sheet in.exr in.exr -o s.png");
  expect_kept("s.png", "compare in.exr in.exr --sheet s.png");
  expect_kept("p.csv", "psf --depth 4 --focus 3 --fstop 2 --focal-length 50 --csv p.csv");
  const std::string scene = "scene plate1 --width 8 --height 8 --truth-samples 1 -o folder";
  for (const std::string name : {"pinhole.exr", "truth.exr", "camera.json"}) {
    expect_kept("folder/" + name, scene);
  }
  expect_kept("trade/index.html", "trade in.exr -o trade" + lens);
  expect_kept("report/report.html", "validate --kernel coc -o report");
}

}  // namespace
}  // namespace defray::test::output_command_test
