// defray sheet as a user runs it.
#include "command/program.h"
#include "image/ldr.h"

namespace defray::test::sheet_command_test {
namespace {

TEST(Sheet, ShowsAPartLargeAndBright) {
  const Folder folder;
  write_picture_file(folder, "a.exr", {"R", "G", "B"});
  write_picture_file(folder, "b.exr", {"B", "R", "G"});
  EXPECT_EQ(defray(folder, "sheet a.exr b.exr -o plain.png").out, "plain.png\n");
  EXPECT_EQ(defray(folder, "sheet a.exr b.exr -o plain.png -q").out, "");
  expect_ok(defray(folder, "sheet a.exr b.exr -o part.png --crop 8x6+2+0 --zoom 3"));
  expect_ok(defray(folder, "sheet a.exr b.exr -o bright.png --exposure 2"));
  const LdrPicture part = read_ldr(folder / "part.png", Content::data);
  const LdrPicture plain = read_ldr(folder / "plain.png", Content::data);
  const LdrPicture bright = read_ldr(folder / "bright.png", Content::data);
  EXPECT_EQ(part.width, 2 * 24 + 8);
  EXPECT_EQ(part.height, 18 + 36);
  const auto at = [](const LdrPicture& p, int x, int y) {
    return p.planes[0][static_cast<std::size_t>(y * p.width + x)];
  };
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (const int i : {0, 1, 2})
        EXPECT_EQ(at(part, 3 * x + i, 36 + 3 * y + i), at(plain, x + 2, 36 + y));
      EXPECT_GE(at(bright, x, 36 + y), at(plain, x, 36 + y));
    }
  }
  EXPECT_GT(at(bright, 4, 40), at(plain, 4, 40));
  const auto refused = [&](const std::string& options, const std::string& words) {
    expect_refusal(defray(folder, "sheet a.exr b.exr -o s.png " + options), 2, {words}, options);
  };
  refused("--zoom 0", "--zoom is 0: allowed are 1 to 64");
  refused("--zoom 65", "--zoom is 65");
  refused("--exposure nan", "--exposure is nan");
  expect_refusal(defray(folder, "sheet a.exr b.exr -o s.png --crop 20x20+40+20"), 3,
                 {"a.exr: --crop 20x20+40+20 reaches outside: allowed is what lies in 48x32+0+0"},
                 "sheet");
}

}  // namespace
}  // namespace defray::test::sheet_command_test
