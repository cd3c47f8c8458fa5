// defray compare where pictures are looked at in part: cut out, masked, of other windows.
#include <OpenImageIO/imagebuf.h>

#include <cmath>

#include "command/measure/compare_command.h"
#include "image/ldr.h"

namespace defray::test::compare_parts_test {
namespace {

using nlohmann::json;

class CompareParts : public ComparePictures {};

TEST_F(CompareParts, APartOfThePictures) {
  // All of the difference is in column 2.
  EXPECT_EQ(compared("a.exr b.exr --crop 10x10+3+4")["equal"], true);
  const json part = compared("a.exr b.exr --crop 4x32+0+0");
  EXPECT_EQ(part["worst_x"], 2);
  EXPECT_NEAR(part["rms"], 0.5 / std::sqrt(12), 1e-6);
  // Places are the whole picture's.
  EXPECT_EQ(compared("a.exr b.exr --crop 4x4+1+5")["worst_x"], 2);
  EXPECT_EQ(compared("a.exr b.exr --crop 4x4+1+5")["worst_y"], 5);
  EXPECT_EQ(code("a.exr b.exr --crop 10x10+3+4 --max-error 0"), 0);
  EXPECT_EQ(code("a.exr b.exr --crop 9x9+39+23"), 0);
  for (const std::string crop : {"9x9+48+0", "9x9+40+0", "9x9+0+24"}) {
    refuse("a.exr b.exr --crop " + crop, 3,
           {"a.exr: --crop " + crop + " reaches outside: allowed is what lies in 48x32+0+0"});
  }
  refuse("a.exr b.exr --crop 9x9-1+0", 3, {"--crop 9x9-1+0 reaches outside"});
  refuse("a.exr b.exr --crop 9x9", 2, {"--crop '9x9'", "3840x2160+100+50"});
  refuse("a.exr b.exr --windows both", 2, {"--windows 'both'", "union overlap"});
}

TEST_F(CompareParts, OnlyWhereAMaskIs) {
  Plane left(48 * 32), column(48 * 32);
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = i % 48 < 2;
    column[i] = i % 48 == 2 ? 1.0f : 0.4f;
  }
  ImageFile::from_planes({"Y"}, {left}, 48, 32).write(folder_ / "left.exr");
  ImageFile::from_planes({"A"}, {column}, 48, 32).write(folder_ / "column.exr");
  ImageFile::from_planes({"Y"}, {Plane(48 * 32)}, 48, 32).write(folder_ / "nothing.exr");
  EXPECT_EQ(compared("a.exr b.exr --mask left.exr")["equal"], true);
  const json line = compared("a.exr b.exr --mask column.exr");
  EXPECT_NEAR(line["rms"], 0.5 / std::sqrt(3), 1e-6);
  EXPECT_NEAR(line["worst"], 0.5, 1e-6);
  EXPECT_EQ(code("a.exr b.exr --mask column.exr --max-error 0.1"), 1);
  // All measures are of these pixels alone.
  const json all = compared("a.exr b.exr");
  EXPECT_LT(line["ssim"].get<double>() + 0.02, all["ssim"].get<double>());
  EXPECT_LT(line["energy_ratio"].get<double>() + 0.02, all["energy_ratio"].get<double>());
  EXPECT_EQ(compared("a.exr b.exr --mask left.exr")["energy_ratio"], 1);
  Plane everywhere(48 * 32, 1.0f);
  ImageFile::from_planes({"Y"}, {everywhere}, 48, 32).write(folder_ / "all.exr");
  json masked = compared("a.exr b.exr --mask all.exr");
  EXPECT_NEAR(masked["ssim"], all["ssim"], 1e-6);
  masked["ssim"] = all["ssim"];
  EXPECT_EQ(masked, all);
  refuse("a.exr b.exr --mask nothing.exr", 3, {"no pixel of the mask"});
  ImageFile::from_planes({"Y"}, {Plane(20 * 10, 1.0f)}, 20, 10).write(folder_ / "small_mask.exr");
  refuse("a.exr b.exr --mask small_mask.exr", 3,
         {"small_mask.exr has display window 20x10+0+0, a.exr has 48x32+0+0: both must be the"});
}

TEST_F(CompareParts, DataWindowsThatDiffer) {
  const auto write = [&](const std::string& name, int x, float value) {
    const Plane plane(8 * 4, value);
    ImageFile file = ImageFile::from_planes({"R", "G", "B"}, {plane, plane, plane}, 8, 4);
    file.write(folder_ / name);
    OIIO::ImageBuf moved(folder_ / name);
    moved.read(0, 0, true, OIIO::TypeDesc::FLOAT);
    moved.specmod().x = x;
    moved.specmod().full_width = 20;
    moved.specmod().full_height = 4;
    moved.write(folder_ / name);
  };
  write("l.exr", 2, 0.5f);
  write("r.exr", 6, 0.5f);
  EXPECT_EQ(compared("l.exr r.exr --windows overlap")["equal"], true);
  const json all = compared("l.exr r.exr");
  EXPECT_NEAR(all["rms"], 0.5 * std::sqrt(8.0 / 12), 1e-6);
  EXPECT_EQ(all["worst_x"], 2) << "of the display window";
  EXPECT_EQ(compared("l.exr r.exr --crop 6x4+8+0")["worst_x"], 10);
  refuse("l.exr r.exr --crop 1x4+0+0", 3, {"nothing is left", "--crop lies where no picture has"});
  refuse("l.exr r.exr --crop 4x4+17+0", 3, {"allowed is what lies in 20x4+0+0"});
  // Beyond the display window where one has data; a mask's data window may be another.
  write("beyond.exr", 14, 0.5f);
  EXPECT_EQ(compared("l.exr beyond.exr --crop 4x4+18+0")["worst_x"], 18);
  refuse("l.exr beyond.exr --crop 4x4+19+0", 3, {"allowed is what lies in 22x4+0+0"});
  write("mask.exr", 2, 1);
  EXPECT_NEAR(compared("l.exr r.exr --mask mask.exr")["rms"], 0.5 * std::sqrt(4.0 / 8), 1e-6);
  const auto width_of_sheet = [&](const std::string& options) {
    expect_ok(defray(folder_, "sheet l.exr r.exr -o s.png " + options));
    return read_ldr(folder_ / "s.png", Content::data).width;
  };
  EXPECT_EQ(width_of_sheet("--windows overlap"), 2 * 4 + 8);
  EXPECT_EQ(width_of_sheet("--windows union"), 2 * 12 + 8);
  EXPECT_EQ(width_of_sheet(""), 2 * 12 + 8);
  // Depth of another window: beyond it there is background.
  Plane depth(8 * 4, 3.0f);
  ImageFile::from_planes({"Z"}, {depth}, 8, 4).write(folder_ / "d.exr");
  OIIO::ImageBuf moved(folder_ / "d.exr");
  moved.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  moved.specmod().x = 4;
  moved.specmod().full_width = 20;
  moved.specmod().full_height = 4;
  moved.write(folder_ / "d.exr");
  const std::string by_depth = "l.exr r.exr --depth d.exr --camera camera.json";
  const json band = compared(by_depth)["edge_band"];
  EXPECT_GT(band["pixels"], 0);
  EXPECT_LT(band["pixels"], 12 * 4);
  // Cut out, the band is that of the whole.
  EXPECT_EQ(compared(by_depth + " --crop 2x4+10+0")["edge_band"]["pixels"].get<int>() +
                compared(by_depth + " --crop 10x4+0+0")["edge_band"]["pixels"].get<int>() +
                compared(by_depth + " --crop 8x4+12+0")["edge_band"]["pixels"].get<int>(),
            band["pixels"].get<int>());
  refuse("a.exr b.exr --depth d.exr --camera camera.json", 3, {"display window 20x4+0+0"});
  write("far.exr", 12, 0.5f);
  refuse("l.exr far.exr --windows overlap", 3, {"the data windows do not overlap"});
  refuse("l.exr a.exr", 3, {"display window 20x4+0+0", "48x32+0+0"});
}

}  // namespace
}  // namespace defray::test::compare_parts_test
