// defray render: data windows that grow with the blur, and what transparent pixels hold.
#include <OpenImageIO/imagebuf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "command/program.h"
#include "image/output.h"

namespace defray::test::windows_command_test {
namespace {

/// A cut-out at one depth, whose data window is its bounding box, within a display window.
class Windows : public testing::Test {
 protected:
  static constexpr int side = 12, frame = 48, at = 18;
  void write(const std::string& name, float alpha, int corner) const {
    std::vector<Plane> planes(5, Plane(side * side, alpha));
    planes[4].assign(side * side, 6.0f);
    planes[3][side + 1] = planes[0][side + 1] = planes[1][side + 1] = planes[2][side + 1] =
        alpha == 1 ? 1.0f : 0.5f;
    ImageFile::from_planes({"R", "G", "B", "A", "Z"}, planes, side, side, Sample::single_float)
        .write(folder_ / "small.exr");
    OIIO::ImageBuf file(folder_ / "small.exr");
    file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
    OIIO::ImageSpec& spec = file.specmod();
    spec.x = spec.y = corner;
    spec.full_width = spec.full_height = frame;
    file.write(folder_ / name);
  }
  ImageFile rendered(const std::string& name, const std::string& options = "") const {
    expect_ok(defray(folder_, "render " + name +
                                  " -o out.exr --focus 3 --fstop 0.25 "
                                  "--focal-length 50 " +
                                  options));
    return ImageFile::read(folder_ / "out.exr");
  }
  Folder folder_;
};

TEST_F(Windows, PlacesAreThoseOfTheDisplayWindow) {
  write("cut.exr", 1, at);
  const std::string optics = " -o out.exr --fstop 2 --focal-length 50 --focus-at ";
  expect_ok(defray(folder_, "render cut.exr" + optics + "20,21"));
  expect_refusal(defray(folder_, "render cut.exr" + optics + "17,20"), 2,
                 {"17,20: cut.exr has pixels from 18,18 to 29,29"}, "left of it");
}

TEST_F(Windows, LargerThanKernelsCountAreRefused) {
  write("cut.exr", 0.75f, at);
  expect_ok(shell(folder_, "oiiotool cut.exr --fullsize 100000x100000+0+0 -o huge.exr"));
  const std::string lens = " --fstop 0.0001 --focal-length 50 --focus 3 ";
  expect_refusal(defray(folder_, "render huge.exr -o out.exr --grow display" + lens), 3,
                 {"huge.exr: its data window, grown by the blur (--grow none lets it be), has ",
                  "allowed are 1 to 65536 a side"},
                 "grown");
  expect_refusal(defray(folder_, "render huge.exr -o out.png --grow none" + lens), 3,
                 {"out.png: the display window has 100000x100000 pixels"}, "png");
  expect_ok(defray(folder_, "render huge.exr -o out.exr --grow none" + lens));
}

/// A frame that the memory does not hold is one that failed, among others.
TEST_F(Windows, AFrameTooLargeForTheMemoryIsABadFrame) {
  write("s.0001.exr", 0.75f, at);
  write("s.0003.exr", 0.75f, at);
  expect_ok(shell(folder_, "oiiotool s.0001.exr --fullsize 16000x16000+0+0 -o s.0002.exr"));
  const Result result = shell(
      folder_, "ulimit -v 3000000; " + program() +
                   " render s.####.exr -o o.####.png --grow none --skip-bad-frames -q --fstop 2 "
                   "--focal-length 50 --focus 3 --device reference");
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_NE(result.err.find("s.0002.exr: not enough memory for this picture"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("1 of 3 frames failed"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "o.0003.png"));
}

TEST_F(Windows, AFrameTooLargeByItsHeaderIsNotRead) {
  std::ofstream(folder_ / "l.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n";
  const Result result = shell(folder_, "ulimit -v 2500000; " + program() + " compare l.hdr l.hdr");
  EXPECT_EQ(result.code, 3) << result.err;
  EXPECT_NE(result.err.find("l.hdr: its pixels take 2929 MiB; there are 2441 MiB of memory"),
            std::string::npos)
      << result.err;
}

TEST_F(Windows, DepthOfALargerOneIsCutToTheColours) {
  write("cut.exr", 1, at);
  const std::string lens = " -o out.exr --fstop 0.25 --focal-length 50 --focus 3 ";
  Plane depth(frame * frame);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = 2.0f + 0.01f * static_cast<float>(i);
  ImageFile::from_planes({"Z"}, {depth}, frame, frame, Sample::single_float)
      .write(folder_ / "depth.exr");
  expect_ok(shell(folder_,
                  "oiiotool depth.exr --cut 12x12+18+18 -o same.exr && oiiotool "
                  "depth.exr --crop 12x12+18+19 -o less.exr"));
  // Cut to its own origin; the picture at that origin has those depths too.
  write("origin.exr", 1, 0);
  expect_ok(defray(folder_, "render cut.exr --depth depth.exr --coc-out a.exr" + lens));
  const Plane coc = ImageFile::read(folder_ / "a.exr").plane(0, 0);
  expect_ok(defray(folder_, "render origin.exr --depth same.exr --coc-out b.exr" + lens));
  EXPECT_EQ(coc, ImageFile::read(folder_ / "b.exr").plane(0, 0));
  expect_refusal(defray(folder_, "render cut.exr --depth less.exr" + lens), 3,
                 {"less.exr: depth Z has data window 12x12+18+19, display window 48x48+0+0",
                  "cut.exr has 12x12+18+18, 48x48+0+0: depth must reach as far",
                  "oiiotool --crop "
                  "12x12+18+18"},
                 "less");
}

TEST_F(Windows, ATightOneGrowsByTheBlur) {
  write("cut.exr", 0.75f, at);
  const ImageFile out = rendered("cut.exr");
  const PartInfo& part = out.parts()[0];
  EXPECT_LT(part.data.x, at);
  EXPECT_GT(part.data.width, side);
  EXPECT_EQ(part.display, (Window{0, 0, frame, frame}));
  EXPECT_TRUE(part.data.x >= 0 && part.data.x + part.data.width <= frame);
  // Nothing is cut off: at the new window's edge there is no light, and all that was is there.
  const Plane alpha = out.plane(0, 3);
  const auto width = static_cast<std::size_t>(part.data.width);
  for (std::size_t x = 0; x < width; ++x) EXPECT_LT(alpha[x], 0.02f);
  double sum = 0;
  for (const float a : alpha) sum += static_cast<double>(a);
  EXPECT_NEAR(sum, 0.75 * side * side - 0.25, 0.01 * side * side);
  // The same as in a frame that was empty around it from the start.
  OIIO::ImageBuf file(folder_ / "cut.exr");
  OIIO::ImageBuf whole(OIIO::ImageSpec(frame, frame, 5, OIIO::TypeDesc::FLOAT));
  whole.specmod().channelnames = file.spec().channelnames;
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float pixel[5];
      file.getpixel(at + x, at + y, pixel);
      whole.setpixel(at + x, at + y, pixel);
    }
  }
  whole.write(folder_ / "whole.exr");
  const Plane all = rendered("whole.exr", "--grow none").plane(0, 3);
  for (int y = 0; y < part.data.height; ++y) {
    for (int x = 0; x < part.data.width; ++x) {
      const std::size_t there = static_cast<std::size_t>(y + part.data.y) * frame +
                                static_cast<std::size_t>(x + part.data.x);
      EXPECT_NEAR(alpha[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)],
                  all[there], 0.01);
    }
  }
}

TEST_F(Windows, GrowAsFarAsAsked) {
  write("edge.exr", 0.75f, 0);
  EXPECT_EQ(rendered("edge.exr", "--grow none").parts()[0].data, (Window{0, 0, side, side}));
  const Window display = rendered("edge.exr").parts()[0].data;
  EXPECT_EQ(display.x, 0);
  EXPECT_GT(display.width, side);
  EXPECT_EQ(rendered("edge.exr", "--grow display").parts()[0].data, display);
  const Window full = rendered("edge.exr", "--grow full").parts()[0].data;
  EXPECT_LT(full.x, 0);
  EXPECT_EQ(full.width - display.width, -full.x);
  // An opaque one is a cut-out of a picture, not of an object.
  write("opaque.exr", 1, at);
  EXPECT_EQ(rendered("opaque.exr").parts()[0].data, (Window{at, at, side, side}));
  EXPECT_GT(rendered("opaque.exr", "--grow display").parts()[0].data.width, side);
  const std::string cut_out = "note: the data window 12x12+18+18 has no transparent pixel";
  const auto says = [&](const std::string& options) {
    return defray(folder_, "render opaque.exr -o out.exr " + options + lens).out.find(cut_out);
  };
  EXPECT_NE(says(""), std::string::npos);
  EXPECT_EQ(says("--grow none"), std::string::npos) << "asked for";
  EXPECT_EQ(says("--grow display"), std::string::npos);
  const Result said = defray(folder_, "render edge.exr -o out.exr" + lens);
  EXPECT_NE(said.out.find("note: the data window 12x12+0+0 grows by the blur to "),
            std::string::npos)
      << said.out;
}

TEST_F(Windows, BlurReachesIntoTheFrameFromOutside) {
  write("outside.exr", 0.75f, -side - 2);
  const std::string options = "--grow display --aperture-diameter 1500 --focus 3 --focal-length 50";
  const std::string nothing = "nothing of it is seen there";
  const Result reaching = defray(folder_, "render outside.exr -o out.exr " + options);
  expect_ok(reaching);
  EXPECT_EQ(reaching.out.find(nothing), std::string::npos) << reaching.out;
  const ImageFile out = ImageFile::read(folder_ / "out.exr");
  const Window data = out.parts()[0].data;
  EXPECT_EQ(data.x, -side - 2) << "no pixel is left out";
  ASSERT_GT(data.x + data.width, 0);
  ASSERT_GT(data.y + data.height, 0);
  EXPECT_GT(to_display_window({out.plane(0, 3)}, data, {0, 0, frame, frame})[0][0], 0.01f);
  // Here nothing reaches in.
  // The second's discs end before the frame's corner.
  for (const std::string rest :
       {"--grow none --fstop 1", "--aperture-diameter 400", "--grow display --fstop 4"}) {
    const Result beside =
        defray(folder_, "render outside.exr -o out.exr --focus 3 --focal-length 50 " + rest);
    expect_ok(beside);
    EXPECT_NE(beside.out.find("12x12-14-14 lies outside the display window 48x48+0+0: " + nothing),
              std::string::npos)
        << beside.out;
    EXPECT_EQ(ImageFile::read(folder_ / "out.exr").parts()[0].data.width, side);
  }
}

TEST_F(Windows, FurtherChannelsGrowToo) {
  write("cut.exr", 0.75f, at);
  const ImageFile out = rendered("cut.exr", "--channels Z");
  const Plane z = out.plane(0, 4);
  EXPECT_EQ(z[0], 0);
  EXPECT_EQ(std::count(z.begin(), z.end(), 6.0f) > 0, true);
}

TEST_F(Windows, NoColourWhereAlphaIsNothing) {
  std::vector<Plane> planes(5, Plane(48 * 32, 0.0f));
  planes[4].assign(48 * 32, 1e10f);
  for (int y = 8; y < 20; ++y) {
    for (int x = 10; x < 30; ++x) {
      const auto i = static_cast<std::size_t>(y * 48 + x);
      for (std::size_t c = 0; c < 4; ++c) planes[c][i] = (x + y) % 3 ? 1.0f : 0.4f;
      planes[4][i] = 2 + 0.1f * static_cast<float>(x);
    }
  }
  const auto stray = [&](float light) {
    planes[0][0] = light;
    ImageFile::from_planes({"R", "G", "B", "A", "Z"}, planes, 48, 32, Sample::single_float)
        .write(folder_ / "in.exr");
    const ImageFile out = rendered("in.exr");
    std::size_t count = 0;
    const Plane red = out.plane(0, 0), alpha = out.plane(0, 3);
    for (std::size_t i = 0; i < red.size(); ++i) count += alpha[i] == 0 && red[i] != 0;
    return count;
  };
  EXPECT_EQ(stray(0), 0u);
  // Light channels too, which have the colour's alpha, or one of their own.
  for (const std::string names : {"diffuse.R,diffuse.G,diffuse.B", "diffuse.R,diffuse.A"}) {
    std::vector<std::string> channels{"R", "G", "B", "A", "Z"};
    std::vector<Plane> all = planes;
    for (const std::string& name : split(names, ',')) {
      channels.push_back(name);
      all.push_back(planes[name.ends_with("A") ? 3 : 0]);
    }
    ImageFile::from_planes(channels, all, 48, 32, Sample::single_float)
        .write(folder_ / "light.exr");
    const ImageFile out = rendered("light.exr", "--channels 'diffuse.*'");
    const auto& found = out.parts()[0].channels;
    const auto plane = [&](const std::string& name) {
      return out.plane(
          0, static_cast<int>(std::find(found.begin(), found.end(), name) - found.begin()));
    };
    const Plane red = plane("diffuse.R"), alpha = plane(names.ends_with("A") ? "diffuse.A" : "A");
    EXPECT_GT(std::accumulate(red.begin(), red.end(), 0.0f), 1);
    for (std::size_t i = 0; i < red.size(); ++i) {
      if (alpha[i] == 0) ASSERT_EQ(red[i], 0) << names << " " << i;
    }
  }
  EXPECT_GT(stray(0.5f), 0u) << "light without a surface, as flames are, stays";
}

}  // namespace
}  // namespace defray::test::windows_command_test
