// defray render: depth that was stored in steps.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "command/render/mistakes_fixture.h"

namespace defray::test::depth_steps_command_test {
namespace {

TEST_F(Mistakes, DepthOfEightBitsMakesNoTerraces) {
  expect_ok(defray(folder_, "scene slanted -o . --width 320 --height 200 --truth-samples 1"));
  const ImageFile scene = ImageFile::read(folder_ / "pinhole.exr");
  const Plane z = scene.plane(0, 3);
  const auto [near, far] = std::minmax_element(z.begin(), z.end());
  cv::Mat stored(200, 320, CV_8UC1);
  for (std::size_t i = 0; i < z.size(); ++i) {
    stored.data[i] = static_cast<unsigned char>(std::lround((z[i] - *near) / (*far - *near) * 255));
  }
  cv::imwrite(folder_ / "z8.png", stored);
  const std::string lens = " --focus 3 --focal-length 150 --fstop 1 --json";
  expect_ok(defray(folder_, "render pinhole.exr -o f.exr" + lens));
  const Result steps = defray(
      folder_, fmt::format("render pinhole.exr --depth z8.png --depth-kind normalized --near {} "
                           "--far {} -o o.exr{}",
                           *near, *far, lens));
  expect_ok(steps);
  EXPECT_NE(steps.out.find("the depth has 8 bits, whose steps change the CoC by up to "),
            std::string::npos)
      << steps.out;
  EXPECT_EQ(steps.out.find("terraces"), std::string::npos) << steps.out;
  EXPECT_EQ(nlohmann::json::parse(steps.out)["chain"]["behind_px"], 0);
  expect_ok(defray(folder_, "compare o.exr f.exr --min-psnr 58"));
}

/// Steps that no pixel is on, 0 among them, need mean no depth.
TEST_F(Mistakes, HalfFloatDepthHasAnyBackground) {
  Plane z(pixels, 4.0f);
  for (const float background : {65504.0f, -1.0f, 0.0f}) {
    z[7] = background;
    write("half.exr", {"Z"}, {z});
    EXPECT_NE(said(fmt::format("half.exr -o o.exr --background {}", background) + usual_)
                  .find("background 1 px"),
              std::string::npos)
        << background;
  }
}

/// What is far away does not shine through a cut-out whose CoC grows along it.
TEST_F(Mistakes, ASlantedCutOutIsOpaqueWithin) {
  constexpr int across = 240, down = 120;
  std::vector<Plane> planes(5, Plane(across * down));
  for (int i = 0; i < across * down; ++i) {
    const int x = i % across, y = i / across;
    const bool is_there = x >= 30 && x < 210 && y >= 12 && y < 108;
    for (std::size_t c = 0; c < 4; ++c) planes[c][static_cast<std::size_t>(i)] = is_there ? 1 : 0;
    planes[4][static_cast<std::size_t>(i)] =
        is_there ? 4 + 0.004f * static_cast<float>(x - 30) : 1e4f;
  }
  for (const Sample depth : {Sample::single_float, Sample::half_float}) {
    ImageFile::from_planes({"R", "G", "B", "A", "Z"}, planes, across, down, depth)
        .write(folder_ / "cut.exr");
    expect_ok(
        defray(folder_, "render cut.exr -o o.exr --focus 4.36 --focal-length 300 --fstop 0.5"));
    const Plane alpha = ImageFile::read(folder_ / "o.exr").plane(0, 3);
    for (int y = 48; y < 72; ++y) {
      for (int x = 72; x < 168; ++x) {
        ASSERT_EQ(alpha[static_cast<std::size_t>(y * across + x)], 1) << x << ", " << y;
      }
    }
  }
}

/// An opaque floor seen through a telephoto lens, its depth in floats and in half floats.
TEST_F(Mistakes, HalfFloatDepthMakesNoRingsAndNoHoles) {
  constexpr int across = 160, down = 64;
  std::vector<Plane> planes(5, Plane(across * down, 1.0f));
  for (std::size_t i = 0; i < planes[4].size(); ++i) {
    planes[4][i] = 6 + 0.0011f * static_cast<float>(i % across);
  }
  const std::vector<std::string> channels{"R", "G", "B", "A", "Z"};
  ImageFile::from_planes(channels, planes, across, down, Sample::single_float)
      .write(folder_ / "floats.exr");
  ImageFile::from_planes(channels, planes, across, down).write(folder_ / "halves.exr");
  const std::string telephoto = " --focus 3 --fstop 0.5 --focal-length 300 --sensor-width 1.4 ";
  EXPECT_EQ(said("floats.exr -o f.exr" + telephoto).find("half floats"), std::string::npos);
  expect_note("halves.exr -o h.exr" + telephoto,
              "the depth is in half floats, whose steps change the CoC by up to ");
  const Plane exact = ImageFile::read(folder_ / "f.exr").plane(0, 3);
  const Plane alpha = ImageFile::read(folder_ / "h.exr").plane(0, 3);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    EXPECT_NEAR(alpha[i], exact[i], 0.01) << i % across;
  EXPECT_EQ(said("halves.exr -o h.exr --focus 6 --fstop 8 --focal-length 50").find("half floats"),
            std::string::npos);
}

/// A plane so steep that each pixel's depth is another half float and its CoC changes by up to 1.2
/// px a pixel: one surface, as in floats.
TEST_F(Mistakes, HalfFloatDepthOfASteepPlane) {
  SKIP_UNLESS_FULL();
  const struct {
    const char *size, *fstop;
  } cases[] = {{"--width 640 --height 96", "0.95"},
               {"--width 640 --height 96", "0.7"},
               {"--width 480 --height 300", "0.7"},
               {"--width 480 --height 300", "0.5"}};
  for (const auto& c : cases) {
    if ((c.fstop == std::string("0.7")) != takes_long_tests()) continue;
    expect_ok(defray(folder_, fmt::format("scene slanted -o . {} --truth-samples 1", c.size)));
    const ImageFile scene = ImageFile::read(folder_ / "pinhole.exr");
    const Window& data = scene.parts()[0].data;
    std::vector<Plane> planes;
    for (int channel = 0; channel < 4; ++channel) planes.push_back(scene.plane(0, channel));
    ImageFile::from_planes(scene.parts()[0].channels, planes, data.width, data.height)
        .write(folder_ / "halves.exr");
    const std::string telephoto =
        fmt::format(" --focus 3 --focal-length 300 --fstop {} --json", c.fstop);
    expect_ok(defray(folder_, "render pinhole.exr -o f.exr" + telephoto));
    const Result halves = defray(folder_, "render halves.exr -o h.exr" + telephoto);
    expect_ok(halves);
    const auto report = nlohmann::json::parse(halves.out);
    EXPECT_NE(halves.out.find("the depth is in half floats"), std::string::npos) << halves.out;
    EXPECT_EQ(report["chain"]["behind_px"], 0) << c.fstop;
    expect_ok(defray(folder_, "compare h.exr f.exr --min-psnr 60"));
  }
}

}  // namespace
}  // namespace defray::test::depth_steps_command_test
