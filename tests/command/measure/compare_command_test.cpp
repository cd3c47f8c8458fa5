// defray compare as a user runs it.
#include "command/measure/compare_command.h"

#include <OpenImageIO/imagebuf.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/ldr.h"

namespace defray::test::compare_command_test {
namespace {

using nlohmann::json;

class Compare : public ComparePictures {};

TEST_F(Compare, JsonHoldsEveryMetric) {
  const json line = compared("a.exr b.exr");
  for (const char* key : {"psnr_srgb_db", "psnr_linear_db", "rms", "worst", "worst_x", "worst_y",
                          "worst_a", "worst_b", "ssim", "energy_ratio"}) {
    EXPECT_TRUE(line.contains(key)) << key;
  }
  EXPECT_FALSE(line.contains("edge_band"));
  EXPECT_NEAR(line["worst"], 0.5, 1e-6);
  EXPECT_EQ(line["worst_x"], 2);
  EXPECT_NEAR(line["worst_b"][0].get<double>() - line["worst_a"][0].get<double>(), 0.5, 1e-6);
  EXPECT_LT(line["energy_ratio"], 1);
  EXPECT_LT(line["ssim"], 1);
  EXPECT_FALSE(line["equal"]);
  EXPECT_TRUE(compared("a.exr a.exr")["equal"]);
}

TEST_F(Compare, SaysWhetherAlphaDiffers) {
  const ImageFile file = ImageFile::read(folder_ / "alpha.exr");
  std::vector<Plane> planes;
  for (int c = 0; c < 4; ++c) planes.push_back(file.plane(0, c));
  const auto write = [&](const std::string& name, float by, std::size_t at) {
    std::vector<Plane> changed = planes;
    changed[3][at] += by;
    ImageFile::from_planes({"R", "G", "B", "A"}, changed, 48, 32, Sample::single_float)
        .write(folder_ / name);
  };
  write("same.exr", 0, 0);
  write("other.exr", -0.25f, 7);
  EXPECT_EQ(compared("same.exr same.exr")["alpha_difference"], 0.0);
  EXPECT_TRUE(compared("same.exr same.exr")["equal"]);
  EXPECT_NEAR(compared("same.exr other.exr")["alpha_difference"], 0.25, 1e-6);
  EXPECT_FALSE(compared("same.exr other.exr")["equal"]);
  EXPECT_FALSE(compared("a.exr same.exr").contains("alpha_difference"));
  const std::string words = "alpha differs by up to 0.25: none of these figures counts it\n";
  EXPECT_NE(defray(folder_, "compare same.exr other.exr").out.find(words), std::string::npos);
  EXPECT_EQ(defray(folder_, "compare same.exr same.exr").out.find("alpha"), std::string::npos);
  ImageFile::from_planes({"Y"}, {Plane(48 * 32, 1.0f)}, 48, 32).write(folder_ / "mask.exr");
  EXPECT_FALSE(compared("same.exr other.exr --mask mask.exr")["equal"]);
  Plane elsewhere(48 * 32, 1.0f);
  elsewhere[7] = 0;
  ImageFile::from_planes({"Y"}, {elsewhere}, 48, 32).write(folder_ / "mask.exr");
  EXPECT_TRUE(compared("same.exr other.exr --mask mask.exr")["equal"]);
}

TEST_F(Compare, TextSaysTheSame) {
  const std::string text =
      defray(folder_, "compare a.exr b.exr --depth z.exr --camera camera.json").out;
  for (const char* part :
       {" dB (sRGB-encoded), ", " dB (linear), both clipped to 0...1\nRMS error ",
        "worst 0.5 at pixel (2, ", "\n  there ", "\nSSIM 0.", "energy ratio 0.", "\nedge band ",
        "\noutside it "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST_F(Compare, BoundsDecideTheExitCode) {
  const json line = compared("a.exr b.exr");
  const double ssim = line["ssim"], psnr = line["psnr_srgb_db"];
  EXPECT_EQ(code("a.exr b.exr --min-ssim " + std::to_string(ssim - 0.001)), 0);
  EXPECT_EQ(code("a.exr b.exr --min-ssim " + std::to_string(ssim + 0.001)), 1);
  EXPECT_EQ(code("a.exr b.exr --min-psnr " + std::to_string(psnr - 0.1)), 0);
  EXPECT_EQ(code("a.exr b.exr --min-psnr " + std::to_string(psnr + 0.1)), 1);
  EXPECT_EQ(code("a.exr b.exr --max-error 0.51"), 0);
  EXPECT_EQ(code("a.exr b.exr --max-error 0.49"), 1);
  EXPECT_EQ(code("a.exr a.exr --max-error 0 --min-ssim 1"), 0);
  const Result missed =
      defray(folder_, "compare a.exr b.exr --min-psnr 99 --min-ssim 1 --max-error 0.25");
  for (const char* said : {"--min-psnr 99 is missed: ", "--min-ssim 1 is missed: 0.",
                           "--max-error 0.25 is missed: 0.5"}) {
    EXPECT_NE(missed.err.find(said), std::string::npos) << said << " is not in " << missed.err;
  }
  EXPECT_NE(defray(folder_, "compare a.exr b.exr --max-error 0.49999999")
                .err.find("--max-error 0.49999999 is missed: 0.5"),
            std::string::npos);
  const Plane bad(1536, NAN);
  ImageFile::from_planes({"R", "G", "B"}, {bad, bad, bad}, 48, 32).write(folder_ / "nan.exr");
  EXPECT_EQ(code("a.exr nan.exr --max-error 9"), 1);
  EXPECT_EQ(code("a.exr nan.exr --min-ssim -1"), 1);
  EXPECT_FALSE(compared("nan.exr nan.exr")["equal"]);
}

TEST_F(Compare, EdgeBandSplitsTheErrors) {
  const json line = compared("a.exr b.exr --depth z.exr --camera camera.json");
  // Focus is on the near half, so the far half's radius counts:
  // 0.5 * 50 mm * (48 * 50 / 36 px) / 3 m * (6 - 3) / 6 = 0.28 px, plus 1, from columns 23 and 24.
  EXPECT_EQ(line["edge_band"]["pixels"], 4 * 32);
  EXPECT_EQ(line["outside_edge_band"]["pixels"], 44 * 32);
  EXPECT_TRUE(line["edge_band"]["psnr_srgb_db"].is_null());  // infinite: no error there
  EXPECT_NEAR(line["outside_edge_band"]["rms"], 0.5 * std::sqrt(32.0 / (3 * 44 * 32)), 1e-6);
  const json equal = compared("a.exr b.exr --depth z.exr --camera camera.json --edge-step 1");
  EXPECT_EQ(equal["edge_band"]["pixels"], 0);
  EXPECT_TRUE(equal["edge_band"]["rms"].is_null());
  const std::string empty =
      defray(folder_, "compare a.exr b.exr --depth z.exr --camera camera.json --edge-step 1").out;
  EXPECT_NE(empty.find("\nedge band 0 px\n"), std::string::npos) << empty;
}

TEST_F(Compare, FocusSettingChoosesTheLens) {
  const std::string base = "a.exr b.exr --depth z.exr --camera two.json --focus-setting ";
  EXPECT_EQ(compared(base + "near")["edge_band"]["pixels"], 4 * 32);
  // 14 px and 1: columns 9 to 38.
  EXPECT_EQ(compared(base + "open")["edge_band"]["pixels"], 30 * 32);
}

TEST_F(Compare, DepthChannelChoosesTheDepth) {
  const Plane flat(1536, 3.0f), steep = ImageFile::read(folder_ / "z.exr").plane(0, 0);
  ImageFile::from_planes({"flat.Z", "steep.Z"}, {flat, steep}, 48, 32).write(folder_ / "zz.exr");
  const std::string base = "a.exr b.exr --depth zz.exr --camera camera.json";
  refuse(base, 3, {"flat.Z, steep.Z", "--depth-channel"});
  EXPECT_EQ(compared(base + " --depth-channel flat.Z")["edge_band"]["pixels"], 0);
  EXPECT_EQ(compared(base + " --depth-channel steep.Z")["edge_band"]["pixels"], 4 * 32);
}

TEST_F(Compare, SheetShowsBothAndTheirDifference) {
  const Result result = defray(folder_, "compare a.exr b.exr --sheet s.png");
  ASSERT_EQ(result.code, 0) << result.err;
  const LdrPicture sheet = read_ldr(folder_ / "s.png", Content::data);
  ASSERT_EQ(sheet.width, 3 * 48 + 2 * 8);
  ASSERT_EQ(sheet.height, 32 + 36);
  const auto red = [&](const LdrPicture& p, int panel, int x, int y) {
    return p.planes[0][std::size_t((36 + y) * p.width + panel * 56 + x)];
  };
  EXPECT_EQ(red(sheet, 0, 30, 5), red(sheet, 1, 30, 5));
  EXPECT_EQ(red(sheet, 2, 30, 5), 1);  // equal: white
  EXPECT_LT(red(sheet, 0, 2, 9), red(sheet, 1, 2, 9));
  EXPECT_LT(red(sheet, 2, 2, 9), 1);
  for (int panel = 0; panel < 3; ++panel) {  // each below its caption
    int ink = 0;
    for (int y = -30; y < -4; ++y) {
      for (int x = 4; x < 14; ++x) ink += red(sheet, panel, x, y) < 0.5f;
    }
    EXPECT_GT(ink, 5) << panel;
  }
  ASSERT_EQ(code("a.exr b.exr --sheet faint.png --amplify 0.5"), 0);
  const LdrPicture faint = read_ldr(folder_ / "faint.png", Content::data);
  EXPECT_GT(red(faint, 2, 2, 9), red(sheet, 2, 2, 9));
  ASSERT_EQ(code("a.exr b.exr --sheet four.png --amplify 4"), 0);  // the default
  const LdrPicture four = read_ldr(folder_ / "four.png", Content::data);
  EXPECT_EQ(red(four, 2, 2, 9), red(sheet, 2, 2, 9));
}

TEST_F(Compare, AlphaIsNoObstacle) {
  EXPECT_EQ(code("a.exr alpha.exr --min-psnr 99"), 0);
  EXPECT_EQ(code("alpha.exr a.exr --min-psnr 99"), 0);
}

TEST_F(Compare, RefusesPicturesThatDoNotGoTogether) {
  refuse("a.exr small.exr", 3, {"a.exr has display window 48x32+0+0", "small.exr has 20x10+0+0"});
  refuse("a.exr depth_only.exr", 3, {"depth_only.exr", "no colour"});
  refuse("a.exr none.exr", 3, {"none.exr", "no such file"});
}

TEST_F(Compare, RefusesHalfAnEdgeBand) {
  refuse("a.exr b.exr --depth z.exr", 2, {"--depth requires --camera"});
  refuse("a.exr b.exr --camera camera.json", 2, {"--camera requires --depth"});
  refuse("a.exr b.exr --focus-setting near", 2, {"--focus-setting requires --camera"});
  refuse("a.exr b.exr --depth '' --camera camera.json", 2, {"--depth", "is empty"});
  refuse("a.exr b.exr --depth z.exr --camera ''", 2, {"--camera", "is empty"});
  refuse("a.exr b.exr --edge-step 1", 2, {"--edge-step requires --depth"});
  refuse("a.exr b.exr --depth-channel Z", 2, {"--depth-channel requires --depth"});
  const std::string lens = " --camera camera.json";
  refuse("a.exr b.exr --depth small.exr" + lens, 3,
         {"small.exr has display window 20x10", "48x32"});
  refuse("a.exr b.exr --depth a.exr" + lens, 3, {"a.exr", "no depth"});
  refuse("a.exr b.exr --depth none.exr" + lens, 3, {"none.exr"});
  refuse("a.exr b.exr --depth z.exr --camera none.json", 3, {"none.json"});
  refuse("a.exr b.exr --depth z.exr --camera two.json", 3, {"near open", "--focus-setting"});
  refuse("a.exr b.exr --depth z.exr --camera two.json --focus-setting opne", 3, {"'open'"});
  refuse("a.exr b.exr --depth z.exr --edge-step -1" + lens, 2, {"--edge-step is -1"});
}

TEST_F(Compare, RefusesBoundsThatMakeNoSense) {
  refuse("a.exr b.exr --min-ssim nan", 2, {"--min-ssim is not a number"});
  refuse("a.exr b.exr --min-ssim 40", 2, {"--min-ssim is 40", "between -1 and 1"});
  refuse("a.exr b.exr --max-error nan", 2, {"--max-error is not a number"});
  refuse("a.exr b.exr --max-error -1", 2, {"--max-error is -1"});
  refuse("a.exr b.exr --min-psnr nan", 2, {"--min-psnr is not a number"});
}

TEST_F(Compare, RefusesSheetsItCannotWrite) {
  refuse("a.exr b.exr --sheet ''", 2, {"--sheet", "is empty"});
  refuse("a.exr b.exr --sheet s.exr", 2, {"s.exr", "PNG or JPEG"});
  refuse("a.exr b.exr --sheet none/s.png", 4, {"none/s.png", "cannot write in folder"});
  refuse("a.exr b.exr --amplify 3", 2, {"--amplify requires --sheet"});
  refuse("a.exr b.exr --sheet s.png --amplify 0", 2, {"--amplify is 0"});
  refuse("a.exr b.exr --sheet s.png --amplify inf", 2, {"--amplify is inf"});
  ASSERT_EQ(defray(folder_, "sheet a.exr -o a.png").code, 0);
  refuse("a.png a.png --sheet ./a.png", 2, {"input and output at once"});
}

}  // namespace
}  // namespace defray::test::compare_command_test
