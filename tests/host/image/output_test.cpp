// What is lost when a picture is written is said, exactly, and what is kept is kept.
#include "image/output.h"

#include <OpenImageIO/imageio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include "image/image_file_part.h"
#include "image/nonfinite.h"
#include "image/safe_output.h"
#include "support.h"

namespace defray::test::output_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

using Notes = std::vector<std::string>;

ImageFile file_of(const Folder& folder, const std::vector<std::string>& channels,
                  Sample sample = Sample::single_float, const std::string& name = "in.exr") {
  ImageFile::from_planes(channels, std::vector<Plane>(channels.size(), Plane(6, 0.5f)), 3, 2,
                         sample)
      .write(folder / name);
  return ImageFile::read(folder / name);
}

Notes written(const std::string& path, ImageFile& file, const std::vector<Plane>& colour) {
  Notes notes;
  write_picture(path, file, choose_colour("in.exr", file.parts(), {}), colour, Bits::as_input,
                notes);
  return notes;
}

TEST(Output, ValuesThat8BitsCannotHoldAreCounted) {
  const Folder folder;
  ImageFile file = file_of(folder, {"R", "G", "B"});
  const Plane fits{0, 1, 0.5f, 1, 0, 1}, none{-1e-6f, 1.00001f, nan, infinite, 0, 1};
  EXPECT_EQ(written(folder / "a.png", file, {fits, fits, fits}), Notes());
  EXPECT_EQ(written(folder / "a.png", file, {fits, none, none}),
            Notes{"8 values outside 0...1 clipped by the 8-bit output"});
  EXPECT_EQ(written(folder / "a.png", file, {fits, fits, {1, 1, 1, 1, 1, 2}}),
            Notes{"1 values outside 0...1 clipped by the 8-bit output"});
  EXPECT_EQ(written(folder / "a.exr", file, {none, none, none}), Notes());
}

TEST(Output, ValuesBeyondHalfFloatsAreCounted) {
  const Folder folder;
  ImageFile file = file_of(folder, {"R", "G", "B"}, Sample::half_float);
  const Plane fits{65504, -65504, infinite, nan, 0, 1e-9f}, beyond{65536, -1e9f, 1, 2, 3, 1e30f};
  EXPECT_EQ(written(folder / "a.exr", file, {fits, fits, fits}), Notes());
  EXPECT_EQ(written(folder / "a.exr", file, {beyond, fits, beyond}),
            Notes{"6 values beyond half float's 65504 are written as Inf"});
  const ImageFile read = ImageFile::read(folder / "a.exr");
  EXPECT_EQ(read.plane(0, 0)[1], -infinite);
  EXPECT_EQ(read.plane(0, 1)[0], 65504);
}

TEST(Output, ChannelsThatStayBehindAreMentioned) {
  const Folder folder;
  ImageFile plain = file_of(folder, {"R", "G", "B", "A"}),
            more = file_of(folder, {"R", "G", "B", "Z"});
  const std::vector<Plane> three(3, Plane(6, 0.5f)), four(4, Plane(6, 0.5f));
  const Notes left_out{"only colour is written: other channels stay behind in a change of format"};
  for (const std::string name : {"a.tif", "a.png", "a.hdr"}) {
    EXPECT_EQ(written(folder / name, plain, four), Notes()) << name;
    EXPECT_EQ(written(folder / name, more, three), left_out) << name;
  }
  EXPECT_EQ(written(folder / "b.exr", more, three), Notes());
  EXPECT_EQ(ImageFile::read(folder / "b.exr").parts()[0].channels.size(), 4u);
  EXPECT_EQ(ImageFile::read(folder / "a.tif").parts()[0].channels.size(), 3u);
  EXPECT_TRUE(keeps_other_channels("b.EXR", more));
  EXPECT_FALSE(keeps_other_channels("b.tif", more) || keeps_other_channels("b.png", more));
  // Radiance files have no alpha.
  written(folder / "c.hdr", plain, four);
  EXPECT_EQ(ImageFile::read(folder / "c.hdr").parts()[0].channels.size(), 3u);
  written(folder / "c.tif", plain, four);
  EXPECT_EQ(ImageFile::read(folder / "c.tif").parts()[0].channels.size(), 4u);
}

TEST(Output, LossyCompressionsAreMentioned) {
  const Folder folder;
  ImageFile file = file_of(folder, {"R", "G", "B"}, Sample::half_float);
  const std::vector<Plane> colour(3, Plane(6, 0.5f));
  for (const char* name : {"dwaa", "dwab:45", "b44", "b44a", "pxr24", "jpeg"}) {
    file.set_compression(name);
    EXPECT_TRUE(file.is_lossy()) << name;
  }
  for (const char* name : {"none", "rle", "zip", "zips", "piz", "lzw"}) {
    file.set_compression(name);
    EXPECT_FALSE(file.is_lossy()) << name;
    if (std::string(name) == "zip") EXPECT_EQ(written(folder / "a.exr", file, colour), Notes());
  }
  file.set_compression("b44");
  const Notes notes = written(folder / "a.exr", file, colour);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("compression is lossy"), std::string::npos);
}

TEST(Output, FormatsAreThoseThatAreNamed) {
  const Folder folder;
  for (const char* name : {"a.exr", "a.TIF", "a.tiff", "a.hdr", "a.png", "a.jpg", "b/a.JPEG"}) {
    EXPECT_NO_THROW(check_output_format(name)) << name;
  }
  expect_error(ErrorKind::usage,
               {"a.gif: cannot write format '.gif'", "allowed are files with .exr"},
               [] { check_output_format("a.gif"); });
  expect_error(ErrorKind::usage, {"picture: has no extension"},
               [] { check_output_format("picture"); });
  expect_error(ErrorKind::usage, {"is a folder"}, [&] { check_output_format(folder.path()); });
  for (const char* name : {"a.exr", "a.tif", "a.tiff"}) {
    EXPECT_NO_THROW(check_plane_format(name, "coc"));
  }
  for (const char* name : {"a.png", "a.hdr", "a"}) {
    expect_error(ErrorKind::usage, {"--coc-out takes .exr or .tif"},
                 [&] { check_plane_format(name, "coc"); });
  }
}

TEST(Output, APlaneHasTheFilesWindows) {
  const Folder folder;
  OIIO::ImageSpec spec(3, 2, 3, OIIO::TypeDesc::HALF);
  spec.x = -1, spec.y = 2;
  spec.full_width = 8, spec.full_height = 6;
  const auto out = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(out->open(folder / "in.exr", spec));
  const Plane pixels(18, 0.5f);
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  ASSERT_TRUE(out->close());
  const Plane values{1e9f, 2, 3, 4, 5, 6.000001f};
  write_plane(folder / "coc.exr", "coc", ImageFile::read(folder / "in.exr"), 0, values);
  const ImageFile read = ImageFile::read(folder / "coc.exr");
  ASSERT_EQ(read.parts()[0].channels, std::vector<std::string>{"coc"});
  EXPECT_EQ(read.parts()[0].data, (Window{-1, 2, 3, 2}));
  EXPECT_EQ(read.parts()[0].display, (Window{0, 0, 8, 6}));
  EXPECT_EQ(read.plane(0, 0), values);
}

/// A picture of one pixel with this metadata.
ImageFile with_metadata(const std::string& path, const OIIO::ImageSpec& spec) {
  const auto out = OIIO::ImageOutput::create(path);
  EXPECT_TRUE(out->open(path, spec));
  const Plane pixel(3, 0.5f);
  EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixel.data()));
  EXPECT_TRUE(out->close());
  return ImageFile::read(path);
}

TEST(Metadata, IsANumberOrATextThatBeginsWithOne) {
  const Folder folder;
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::HALF);
  spec.attribute("whole", 35);
  spec.attribute("broken", 2.8f);
  spec.attribute("text", "85.5 mm");
  spec.attribute("words", "mm 85");
  const int half[] = {1, 2}, unknown[] = {1, 0};
  const float pair[] = {1.5f, 2};
  const double exact = 5.6;
  spec.attribute("half", OIIO::TypeRational, half);
  spec.attribute("unknown", OIIO::TypeRational, unknown);
  spec.attribute("whole pair", OIIO::TypeDesc("int[2]"), half);
  spec.attribute("pair", OIIO::TypeDesc("float[2]"), pair);
  spec.attribute("exact", OIIO::TypeDesc("double"), &exact);
  const ImageFile file = with_metadata(folder / "in.exr", spec);
  EXPECT_EQ(file.metadata_number("whole"), 35);
  EXPECT_FLOAT_EQ(static_cast<float>(file.metadata_number("broken").value()), 2.8f);
  EXPECT_EQ(file.metadata_number("text"), 85.5);
  EXPECT_FALSE(file.metadata_number("words"));
  EXPECT_FALSE(file.metadata_number("none"));
  EXPECT_EQ(file.metadata_number("half"), 0.5);
  EXPECT_FALSE(file.metadata_number("unknown"));
  EXPECT_EQ(file.metadata_number("whole pair"), 1);
  EXPECT_EQ(file.metadata_number("pair"), 1.5);
  EXPECT_EQ(file.metadata_number("exact"), 5.6);
}

template <typename T>
std::optional<double> number_in(OIIO::TypeDesc type, T value) {
  return number_of(OIIO::ParamValue("x", type, 1, &value));
}

TEST(Metadata, MayBeOfAnyNumericType) {
  using OIIO::TypeDesc;
  EXPECT_EQ(number_in<std::uint8_t>(TypeDesc::UINT8, 200), 200);
  EXPECT_EQ(number_in<std::int8_t>(TypeDesc::INT8, -5), -5);
  EXPECT_EQ(number_in<std::uint16_t>(TypeDesc::UINT16, 50000), 50000);
  EXPECT_EQ(number_in<std::int16_t>(TypeDesc::INT16, -7), -7);
  EXPECT_EQ(number_in<std::uint32_t>(TypeDesc::UINT32, 4000000001u), 4000000001.0);
  EXPECT_EQ(number_in<std::int32_t>(TypeDesc::INT32, -9), -9);
  EXPECT_EQ(number_in<std::uint64_t>(TypeDesc::UINT64, 1ull << 40), std::ldexp(1, 40));
  EXPECT_EQ(number_in<std::int64_t>(TypeDesc::INT64, -3), -3);
  EXPECT_EQ(number_in<std::uint16_t>(TypeDesc::HALF, 0x4100), 2.5);
  EXPECT_EQ(number_in<float>(TypeDesc::FLOAT, 1.5f), 1.5);
  EXPECT_EQ(number_in<double>(TypeDesc::DOUBLE, 5.6), 5.6);
  EXPECT_FALSE(number_in<const char*>(TypeDesc::PTR, nullptr));
}

TEST(NonfiniteColours, AreCountedZeroedOrNamedWithTheirPlace) {
  const std::vector<Plane> colour{{1, nan, 3, 4, 5, 6}, {infinite, 2, 3, 4, 5, -infinite}};
  const Window data{10, 20, 3, 2};
  std::vector<Plane> kept = colour, zeroed = colour, refused = {colour[0], colour[0]};
  EXPECT_EQ(handle_nonfinite(kept, Nonfinite::keep, data, "a.exr"), 3u);
  EXPECT_TRUE(std::isnan(kept[0][1]));
  EXPECT_EQ(kept[1], colour[1]);
  EXPECT_EQ(handle_nonfinite(zeroed, Nonfinite::zero, data, "a.exr"), 3u);
  EXPECT_EQ(zeroed, (std::vector<Plane>{{1, 0, 3, 4, 5, 6}, {0, 2, 3, 4, 5, 0}}));
  EXPECT_EQ(handle_nonfinite(zeroed, Nonfinite::error, data, "a.exr"), 0u);
  expect_error(ErrorKind::input, {"a.exr: colour nan at pixel (11, 20)"},
               [&] { handle_nonfinite(refused, Nonfinite::error, data, "a.exr"); });
  refused = {colour[1]};
  refused[0][0] = 1;
  expect_error(ErrorKind::input, {"colour -inf at pixel (12, 21)"},
               [&] { handle_nonfinite(refused, Nonfinite::error, data, "a.exr"); });
}

}  // namespace
}  // namespace defray::test::output_test
