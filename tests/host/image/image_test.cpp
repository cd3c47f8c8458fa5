// Image files: what is read is written back; what is damaged is refused.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <fstream>

#include "base/text.h"
#include "image/image_file.h"
#include "image/ldr.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "measure/metrics.h"
#include "support.h"

namespace defray::test::image_test {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ImageFile, RoundTripKeepsHalfAndFloat) {
  const Folder folder;
  const Plane r{0.1f, 65504, -2, 0}, z{1.00001f, 3e8f, 7, 1e-7f};
  for (const Sample sample : {Sample::half_float, Sample::single_float}) {
    ImageFile::from_planes({"R", "Z"}, {r, z}, 2, 2, sample).write(folder / "a.exr");
    const ImageFile read = ImageFile::read(folder / "a.exr");
    const double tolerance = sample == Sample::half_float ? 1e-3 : 0;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(read.plane(0, 0)[i], r[i], tolerance);
  }
}

TEST(ImageFile, SharedMultiPartFileSurvivesUntouched) {
  SKIP_WITHOUT_SHARED();
  const Folder folder;
  const ImageFile in = ImageFile::read(shared_folder() + "/images/beachball/multipart.0001.exr");
  in.write(folder / "out.exr");
  const ImageFile out = ImageFile::read(folder / "out.exr");
  ASSERT_EQ(in.parts().size(), 10u);
  ASSERT_EQ(out.parts().size(), 10u);
  for (std::size_t p = 0; p < 10; ++p) {
    EXPECT_EQ(in.parts()[p].name, out.parts()[p].name);
    EXPECT_EQ(in.parts()[p].view, out.parts()[p].view);
    EXPECT_EQ(in.parts()[p].data, out.parts()[p].data);
    EXPECT_EQ(in.parts()[p].display, out.parts()[p].display);
    ASSERT_EQ(in.parts()[p].channels, out.parts()[p].channels);
    for (std::size_t c = 0; c < in.parts()[p].channels.size(); ++c) {
      const int part = static_cast<int>(p), channel = static_cast<int>(c);
      EXPECT_EQ(hash_of({in.plane(part, channel)}), hash_of({out.plane(part, channel)}));
    }
  }
}

TEST(ImageFile, EveryDamagedFileIsRefusedUnderBothNames) {
  SKIP_WITHOUT_SHARED();
  const Folder folder;
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(shared_folder() + "/images/damaged")) {
    const std::string copy = folder / "damaged.exr";
    std::filesystem::copy_file(entry.path(), copy,
                               std::filesystem::copy_options::overwrite_existing);
    for (const std::string& path : {entry.path().string(), copy}) {
      expect_error(ErrorKind::input, {path}, [&] { ImageFile::read(path); });
    }
    ++count;
  }
  EXPECT_EQ(count, 92u);
}

TEST(ImageFile, TwoPartsStayTwoParts) {
  const Folder folder;
  std::vector<OIIO::ImageSpec> specs;
  for (const int width : {5, 7}) {
    OIIO::ImageSpec spec(width, 3, 2, OIIO::TypeDesc::FLOAT);
    spec.full_width = 7;
    spec.attribute("name", "part" + std::to_string(width));
    specs.push_back(spec);
  }
  const auto out = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(out->open(folder / "two.exr", 2, specs.data())) << out->geterror();
  for (std::size_t p = 0; p < 2; ++p) {
    if (p > 0) {
      ASSERT_TRUE(out->open(folder / "two.exr", specs[p], OIIO::ImageOutput::AppendSubimage));
    }
    const Plane pixels = random_plane({42, 1}, 3);
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << out->geterror();
  }
  ASSERT_TRUE(out->close());
  const ImageFile two = ImageFile::read(folder / "two.exr");
  two.write(folder / "again.exr");
  const ImageFile again = ImageFile::read(folder / "again.exr");
  ASSERT_EQ(again.parts().size(), 2u);
  for (int p = 0; p < 2; ++p) {
    EXPECT_EQ(again.parts()[static_cast<std::size_t>(p)].data.width, p == 0 ? 5 : 7);
    for (int c = 0; c < 2; ++c) EXPECT_EQ(again.plane(p, c), two.plane(p, c));
  }
  // One of them alone does not keep the count that files of several parts have.
  two.extract(1, {0}).write(folder / "one.exr");
  const auto one = OIIO::ImageInput::open(folder / "one.exr");
  ASSERT_TRUE(one) << OIIO::geterror();
  EXPECT_EQ(one->spec().find_attribute("openexr:chunkCount"), nullptr);
}

TEST(ImageFile, TruncatedAtEveryLength) {
  const Folder folder;
  const Size size{40, 30};
  ImageFile::from_planes({"R", "G", "B"},
                         {random_plane(size, 1), random_plane(size, 2), random_plane(size, 3)}, 40,
                         30)
      .write(folder / "whole.exr");
  const std::string whole = bytes_of(folder / "whole.exr");
  for (std::size_t length = 0; length + 40 < whole.size(); length += 97) {
    std::ofstream(folder / "cut.exr", std::ios::binary) << whole.substr(0, length);
    expect_error(ErrorKind::input, {"cut.exr"}, [&] { ImageFile::read(folder / "cut.exr"); });
  }
}

TEST(ImageFile, AbsurdHeaderSizesAreRefusedBeforeAllocation) {
  const Folder folder;
  ImageFile::from_planes({"R"}, {Plane(4)}, 2, 2).write(folder / "a.exr");
  std::string bytes = bytes_of(folder / "a.exr");
  const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;
  const std::uint32_t far_right = 3000000;
  bytes.replace(window + 8, 4, reinterpret_cast<const char*>(&far_right), 4);
  std::ofstream(folder / "huge.exr", std::ios::binary) << bytes;
  expect_error(ErrorKind::input, {"huge.exr", "3000001x2", "allowed"},
               [&] { ImageFile::read(folder / "huge.exr"); });
}

TEST(ImageFile, MissingFilesAndFolders) {
  const Folder folder;
  expect_error(ErrorKind::input, {"none.exr", "no such file"},
               [&] { ImageFile::read(folder / "none.exr"); });
  expect_error(ErrorKind::input, {"is a folder"}, [&] { ImageFile::read(folder.path()); });
  expect_error(ErrorKind::input, {"s.####.exr: no such file; here goes one picture"},
               [&] { ImageFile::read(folder / "s.####.exr"); });
}

TEST(Ldr, EncodesAndDecodesSrgb) {
  for (int i = 0; i <= 255; ++i) {
    EXPECT_NEAR(255 * srgb_encode(srgb_decode(i / 255.0)), i, 1e-9);
  }
  EXPECT_NEAR(srgb_encode(0.18), 0.4613561, 1e-6);  // middle grey
}

TEST(Ldr, EveryByteSurvivesPng) {
  const Folder folder;
  LdrPicture picture{16, 16, {"R", "G", "B"}, std::vector<Plane>(3, Plane(256))};
  for (std::size_t i = 0; i < 256; ++i) {
    picture.planes[0][i] = static_cast<float>(srgb_decode(i / 255.0));
    picture.planes[1][i] = 0.25f;
    picture.planes[2][i] = 2;  // clipped to 1
  }
  write_ldr(folder / "a.png", picture);
  const LdrPicture read = read_ldr(folder / "a.png");
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_NEAR(read.planes[0][i], picture.planes[0][i], 1e-6) << i;
    EXPECT_EQ(read.planes[2][i], 1);
  }
}

TEST(ImageFile, ItsBitsAreThoseItWasGivenLast) {
  const Folder folder;
  std::vector<std::uint16_t> values = {0, 1, 257, 32768, 65534, 65535};
  OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::UINT16);
  OIIO::ImageBuf(spec, values.data()).write(folder / "a.tif");
  ImageFile file = ImageFile::read(folder / "a.tif");
  EXPECT_EQ(file.parts()[0].integer_bits, 16);
  file.set_bits(0, {}, Bits::eight);
  EXPECT_EQ(file.parts()[0].integer_bits, 8);
}

TEST(Ldr, SixteenBitsSpanFromBlackToWhite) {
  const Folder folder;
  std::vector<std::uint16_t> values = {0, 1, 257, 32768, 65534, 65535};
  OIIO::ImageSpec spec(6, 1, 1, OIIO::TypeDesc::UINT16);
  OIIO::ImageBuf(spec, values.data()).write(folder / "a.png");
  const LdrPicture read = read_ldr(folder / "a.png");
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(read.planes[0][i], static_cast<float>(srgb_decode(values[i] / 65535.0))) << i;
  }
  EXPECT_EQ(read.planes[0].back(), 1.0f);
}

TEST(Ldr, EachPixelHasItsOwnAlpha) {
  const Folder folder;
  const Plane alpha{0.2f, 0.4f, 0.6f, 0.8f, 1, 0};
  write_ldr(folder / "a.png", {3, 2, {"R", "G", "B", "A"}, {alpha, alpha, alpha, alpha}});
  const LdrPicture read = read_ldr(folder / "a.png");
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    EXPECT_FLOAT_EQ(read.planes[3][i], alpha[i]);  // 51, 102, ... of 255
    EXPECT_NEAR(read.planes[0][i], alpha[i], 1e-6);
  }
}

TEST(Ldr, PngAlphaIsStraightAndOursPremultiplied) {
  const Folder folder;
  write_ldr(folder / "a.png", {1, 1, {"R", "G", "B", "A"}, {{0.25f}, {0.1f}, {0}, {0.5f}}});
  const LdrPicture read = read_ldr(folder / "a.png");
  ASSERT_EQ(read.planes.size(), 4u);
  EXPECT_NEAR(read.planes[0][0], 0.25, 0.004);
  EXPECT_NEAR(read.planes[3][0], 0.5, 0.002);
}

TEST(Ldr, DataIsTakenAsStored) {
  const Folder folder;
  const Plane half{static_cast<float>(srgb_decode(0.5))};
  write_ldr(folder / "a.png", {1, 1, {"R", "G", "B"}, {half, half, half}});
  EXPECT_NEAR(read_ldr(folder / "a.png", Content::data).planes[0][0], 0.5, 0.002);
}

TEST(Output, DisplayWindowCropsAndPads) {
  const Window display{0, 0, 4, 3};
  const Plane inside = to_display_window({{1, 2}}, {1, 1, 2, 1}, display)[0];
  EXPECT_EQ(inside, (Plane{0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0}));
  Plane over(36);
  for (std::size_t i = 0; i < 36; ++i) over[i] = static_cast<float>(i);
  const Plane cropped = to_display_window({over}, {-1, -1, 6, 6}, display)[0];
  EXPECT_EQ(cropped, (Plane{7, 8, 9, 10, 13, 14, 15, 16, 19, 20, 21, 22}));
  EXPECT_EQ(to_display_window({{5}}, {9, 9, 1, 1}, display)[0], Plane(12));
}

TEST(Metrics, KnownDifferences) {
  const Plane a(100, 0.5f), b(100, 0.6f);
  const Comparison c = compare({a, a, a}, {b, b, b}, 10);
  EXPECT_NEAR(c.psnr_linear_db, 20, 1e-4);
  EXPECT_NEAR(c.psnr_srgb_db, -20 * std::log10(srgb_encode(0.6) - srgb_encode(0.5)), 1e-4);
  EXPECT_NEAR(c.rms, 0.1, 1e-6);
  Plane spot = a;
  spot[37] = 3;
  const Comparison worst = compare({a, a, spot}, {a, a, a}, 10);
  EXPECT_EQ(worst.worst_x, 7);
  EXPECT_EQ(worst.worst_y, 3);
  EXPECT_NEAR(worst.worst, 2.5, 1e-6);
  EXPECT_TRUE(std::isinf(compare({a, a, a}, {a, a, a}, 10).psnr_srgb_db));
}

TEST(Text, JoinUndoesSplit) {
  for (const std::string text : {"a.b", ".a", "a..b", "..a", "a"}) {
    EXPECT_EQ(join(split(text, '.'), "."), text);
  }
}

TEST(Text, NearestSpelling) {
  const std::vector<std::string> words{"--focus", "--fstop", "--focal-length"};
  EXPECT_EQ(nearest_spelling("--focsu", words), "--focus");
  EXPECT_EQ(nearest_spelling("--fstp", words), "--fstop");
  EXPECT_EQ(nearest_spelling("--focal-lenght", words), "--focal-length");
  EXPECT_EQ(nearest_spelling("--zzz", words), "");
}

TEST(Image, APartOfAFileKeepsItsAlpha) {
  const Folder folder;
  const Plane v(6, 0.5f);
  const ImageFile file = ImageFile::from_planes({"A", "R", "G", "B"}, {v, v, v, v}, 3, 2);
  const auto alpha_of = [&](const std::vector<int>& channels) {
    file.extract(0, channels).write(folder / "part.tif");
    return OIIO::ImageInput::open(folder / "part.tif")->spec().alpha_channel;
  };
  EXPECT_EQ(alpha_of({1, 2, 3, 0}), 3);
  EXPECT_EQ(alpha_of({1, 2, 3}), -1);
}

}  // namespace
}  // namespace defray::test::image_test
