// How 'defray render' stores what it writes.
#include <OpenImageIO/imageio.h>

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

}  // namespace
}  // namespace defray::test::output_command_test
