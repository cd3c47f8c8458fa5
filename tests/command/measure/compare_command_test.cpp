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

class Compare : public CompareCommand {
 protected:
  Compare() {
    write_picture_file(folder_, "a.exr", {"R", "G", "B"});
    write_picture_file(folder_, "alpha.exr", {"R", "G", "B", "A"});
    write_picture_file(folder_, "small.exr", {"R", "G", "B", "Z"}, {20, 10});
    write_picture_file(folder_, "depth_only.exr", {"Z"});
    const ImageFile a = ImageFile::read(folder_ / "a.exr");
    std::vector<Plane> planes;
    for (int c = 0; c < 3; ++c) planes.push_back(a.plane(0, c));  // stored as R G B
    // Half the frame is near, half far; the difference lies in a column far from that edge.
    Plane depth(planes[0].size());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = i % 48 < 24 ? 3 : 6;
      if (i % 48 == 2) planes[0][i] += 0.5f;
    }
    ImageFile::from_planes({"R", "G", "B"}, planes, 48, 32, Sample::single_float)
        .write(folder_ / "b.exr");
    ImageFile::from_planes({"Z"}, {depth}, 48, 32, Sample::single_float).write(folder_ / "z.exr");
    write_camera("camera.json", R"({"only": {"focus_distance_m": 3, "f_stop": 1}})");
    write_camera("two.json", R"({"near": {"focus_distance_m": 3, "f_stop": 1},
                                 "open": {"focus_distance_m": 3, "f_stop": 0.02}})");
  }

  void write_camera(const std::string& name, const std::string& settings) {
    std::ofstream(folder_ / name) << R"({"focal_length_mm": 50, "focus_settings": )" << settings
                                  << "}";
  }

  json compared(const std::string& arguments) {
    const Result result = defray(folder_, "compare --json " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
};

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

TEST_F(Compare, APartOfThePictures) {
  // All of the difference is in column 2.
  EXPECT_EQ(compared("a.exr b.exr --crop 10x10+3+4")["equal"], true);
  const json part = compared("a.exr b.exr --crop 4x32+0+0");
  EXPECT_EQ(part["worst_x"], 2);
  EXPECT_NEAR(part["rms"], 0.5 / std::sqrt(12), 1e-6);
  // Places are the whole picture's.
  EXPECT_EQ(compared("a.exr b.exr --crop 4x4+1+5")["worst_x"], 2);
  EXPECT_EQ(compared("a.exr b.exr --crop 4x4+1+5")["worst_y"], 5);
  EXPECT_EQ(code("a.exr b.exr --crop 10x10+3+4 --max-error 0"), 0);
  refuse("a.exr b.exr --crop 9x9+48+0", 3, {"--crop lies outside"});
  refuse("a.exr b.exr --crop 9x9", 2, {"--crop '9x9'", "3840x2160+100+50"});
  refuse("a.exr b.exr --windows both", 2, {"--windows 'both'", "union overlap"});
}

TEST_F(Compare, OnlyWhereAMaskIs) {
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
}

TEST_F(Compare, DataWindowsThatDiffer) {
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
}  // namespace defray::test::compare_command_test
