// defray render from the command line: options, files, sequences.
#include <OpenImageIO/imagebuf.h>

#include <cmath>
#include <fstream>

#include "command/program.h"

namespace defray::test::render_command_test {
namespace {

/// Hash of what a render with these options writes.
std::uint64_t rendered(const Folder& folder, const std::string& options,
                       const std::string& input = "in.exr") {
  std::filesystem::remove(folder / "out.exr");
  const Result result = defray(folder, "render " + input + " -o out.exr " + options);
  EXPECT_EQ(result.code, 0) << options << "\n" << result.err;
  return result.code == 0 ? file_hash(folder / "out.exr") : 0;
}

TEST(Render, ReportsWhatItChose) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"A", "B", "G", "R", "Z"});
  const Result result = defray(folder, "render in.exr -o out.exr" + lens);
  expect_ok(result);
  for (const char* words :
       {"colour R G B A", "depth Z", "lens 50 mm", "CoC radius", "data window"}) {
    EXPECT_NE(result.out.find(words), std::string::npos) << words << " in " << result.out;
  }
  EXPECT_EQ(result.err, "");
}

TEST(Render, EveryOptionChangesThePicture) {
  const Folder folder;
  write_picture_file(folder, "in.exr",
                     {"R", "G", "B", "Z", "other.R", "other.G", "other.B", "far.Z"});
  write_picture_file(folder, "z.exr", {"a.Z", "b.Z", "Z"});
  std::ofstream(folder / "camera.json")
      << R"({"focal_length_mm": 35, "focus_settings": {"a": {"focus_distance_m": 2, "f_stop": 0.7},
             "b": {"focus_distance_m": 5, "f_stop": 0.7}}})";
  const std::uint64_t base = rendered(folder, lens);
  const std::vector<std::string> changing{
      "--focus 4 --fstop 0.5 --focal-length 50",
      "--focus inf --fstop 0.5 --focal-length 50",
      "--focus 3 --fstop 0.8 --focal-length 50",
      "--focus 3 --aperture-diameter 60 --focal-length 50",
      "--focus 3 --fstop 0.5 --focal-length 60",
      lens + "--sensor-width 20",
      lens + "--lens-model breathing",
      lens + "--max-coc 1.5",
      lens + "--unit cm --focus 500",
      lens + "--unit 0.5",
      lens + "--rdb 5",
      lens + "--literal --jitter",
      lens + "--literal --jitter --seed 3",
      lens + "--depth-kind distance",
      lens + "--depth-kind inverse",
      lens + "--depth-kind normalized --near 10 --far 11",
      lens + "--depth-kind normalized --near 10 --far 11 --invert",
      lens + "--depth-channel far.Z",
      lens + "--layer other",
      lens + "--depth z.exr",
      lens + "--depth z.exr --depth-channel a.Z",
      "--camera camera.json --focus-setting a",
      "--camera camera.json --focus-setting b",
  };
  std::map<std::uint64_t, std::string> seen{{base, "the plain lens"}};
  for (const std::string& options : changing) {
    // --unit cm moves the focus too: keep the last value of a repeated option.
    std::string line = options;
    if (options.find("--unit cm") != std::string::npos) {
      line = "--unit cm --focus 50 --fstop 0.5 --focal-length 50";
    }
    const auto [at, is_new] = seen.emplace(rendered(folder, line), line);
    EXPECT_TRUE(is_new) << line << " gives the same picture as " << at->second;
  }
}

TEST(Render, MemoryAndWorkGroupChangeNoBit) {
  SKIP_UNLESS_FULL();
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}, {97, 61});
  const std::string literal = lens + "--literal ";
  const std::uint64_t base = rendered(folder, lens), literal_base = rendered(folder, literal);
  for (const char* options : {"--memory 0.3", "--memory 1", "--work-group 7x3", "--work-group 16",
                              "--memory 0.3 --work-group 1x1"}) {
    EXPECT_EQ(rendered(folder, lens + options), base) << options;
    EXPECT_EQ(rendered(folder, literal + options), literal_base) << options;
  }
  EXPECT_EQ(rendered(folder, literal + "--memory 0.006"), literal_base);
}

TEST(Render, ReferenceDeviceAgrees) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  expect_ok(defray(folder, "render in.exr -o cl.exr" + lens));
  expect_ok(defray(folder, "render in.exr -o twin.exr --device reference" + lens));
  // Not 100: a CoC on a rounding boundary may come out one quantum (1/256 px) apart.
  expect_ok(defray(folder, "compare cl.exr twin.exr --min-psnr 60"));
}

/// A pixel of the file below, as OpenImageIO orders channels.
struct __attribute__((packed)) MixedPixel {
  std::uint16_t r, g, b, a;
  float z;
  std::uint32_t id;
};

std::vector<MixedPixel> read_mixed(const std::string& path, OIIO::ImageSpec& spec) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return {};
  spec = input->spec();
  std::vector<MixedPixel> pixels(200);
  EXPECT_TRUE(input->read_image(0, 0, 0, 6, OIIO::TypeDesc::UNKNOWN, pixels.data()));
  return pixels;
}

TEST(Render, KeepsWindowsMetadataTypesAndOtherChannels) {
  const Folder folder;
  OIIO::ImageSpec spec(20, 10, 6, OIIO::TypeDesc::HALF);
  spec.channelnames = {"R", "G", "B", "A", "Z", "id"};
  spec.channelformats = {OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF,  OIIO::TypeDesc::HALF,
                         OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::UINT32};
  spec.x = 5, spec.y = 7, spec.full_width = 64, spec.full_height = 48;
  spec.attribute("compression", "piz");
  spec.attribute("shot", "sq01_010");
  std::vector<MixedPixel> pixels(200);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto blue = static_cast<std::uint16_t>(0x3000 + 7 * (i % 31));
    pixels[i] = {0x3c00, 0x3800, blue, 0x3c00, 2.0f + float(i), 4000000000u + i};
  }
  const auto output = OIIO::ImageOutput::create(folder / "in.exr");
  ASSERT_TRUE(output->open(folder / "in.exr", spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UNKNOWN, pixels.data()));
  output->close();
  expect_ok(defray(folder, "render in.exr -o out.exr" + lens));

  OIIO::ImageSpec before, after;
  ASSERT_EQ(read_mixed(folder / "in.exr", before).size(), 200u);
  const std::vector<MixedPixel> read = read_mixed(folder / "out.exr", after);
  EXPECT_EQ(after.x, 5);
  EXPECT_EQ(after.y, 7);
  EXPECT_EQ(after.full_width, 64);
  EXPECT_EQ(after.full_height, 48);
  EXPECT_EQ(after.channelnames, spec.channelnames);
  EXPECT_EQ(after.channelformats, spec.channelformats);
  EXPECT_EQ(after.get_string_attribute("compression"), "piz");
  EXPECT_EQ(after.get_string_attribute("shot"), "sq01_010");
  EXPECT_EQ(after.extra_attribs.size(), before.extra_attribs.size());
  std::size_t blurred = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(read[i].id, pixels[i].id);
    EXPECT_EQ(read[i].z, pixels[i].z);
    blurred += read[i].b != pixels[i].b;
  }
  EXPECT_GT(blurred, 20u);
}

TEST(Render, LensFromMetadataWhenAskedFor) {
  const Folder folder;
  write_picture_file(folder, "plain.exr", {"R", "G", "B", "Z"});
  OIIO::ImageBuf picture(folder / "plain.exr");
  picture.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  const auto with = [&](const std::string& name, const std::map<std::string, float>& values) {
    OIIO::ImageBuf copy(picture);
    for (const auto& [key, value] : values) copy.specmod().attribute(key, value);
    copy.write(folder / name);
  };
  with("exr.exr", {{"focus", 3.0f}, {"FNumber", 0.5f}, {"FocalLength", 50.0f}});
  with("nuke.exr", {{"exr/nuke/camera/focal", 50.0f},
                    {"exr/nuke/camera/haperture", 24.0f},
                    {"FNumber", 0.5f},
                    {"focus", 3.0f}});
  with("vray.exr", {{"cameraFocalLength", 50.0f},
                    {"cameraAperture", 36.0f},
                    {"cameraFNumber", 0.5f},
                    {"cameraFocusDistance", 3.0f}});
  const std::uint64_t expected = rendered(folder, lens, "plain.exr");
  EXPECT_EQ(rendered(folder, "--camera from-metadata", "exr.exr"), expected);
  EXPECT_EQ(rendered(folder, "--camera from-metadata", "vray.exr"), expected);
  EXPECT_EQ(rendered(folder, "--camera from-metadata", "nuke.exr"),
            rendered(folder, lens + "--sensor-width 24", "plain.exr"));
  EXPECT_NE(rendered(folder, "--camera from-metadata --focus 5", "exr.exr"), expected);
  // The standard's focus is in metres, V-Ray's in scene units; 2 metres are one unit here.
  with("near.exr", {{"focus", 6.0f}, {"FNumber", 0.5f}, {"FocalLength", 50.0f}});
  const std::string in_two_metres = "--unit 2 ";
  EXPECT_EQ(rendered(folder, "--camera from-metadata " + in_two_metres, "near.exr"),
            rendered(folder, lens + in_two_metres, "plain.exr"));
  EXPECT_EQ(rendered(folder, "--camera from-metadata " + in_two_metres, "vray.exr"),
            rendered(folder, lens + in_two_metres, "plain.exr"));
  const Result missing = defray(folder, "render plain.exr -o out.exr --camera from-metadata");
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("--focus, --focal-length, --fstop"), std::string::npos) << missing.err;
}

TEST(Render, WritesTheSignedCoc) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  const Result result = defray(folder, "render in.exr -o out.exr --coc-out coc.exr" + lens);
  expect_ok(result);
  EXPECT_EQ(result.out.rfind("in.exr -> out.exr\n", 0), 0u) << result.out;
  const ImageFile coc = ImageFile::read(folder / "coc.exr");
  const ImageFile in = ImageFile::read(folder / "in.exr");
  ASSERT_EQ(coc.parts()[0].channels, std::vector<std::string>{"coc"});
  const Plane z = in.plane(0, 3), r = coc.plane(0, 0);
  const double k = 0.5 * 0.1 * (48 * 50.0 / 36) / 3;
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_NEAR(r[i], k * (z[i] - 3) / z[i], 1.0 / 500);
  const Result bad = defray(folder, "render in.exr -o out.exr --coc-out coc.png" + lens);
  EXPECT_EQ(bad.code, 2) << bad.err;
}

TEST(Render, ApertureZeroReturnsTheInputBitForBit) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  EXPECT_EQ(rendered(folder, "--focus 3 --aperture-diameter 0 --focal-length 50"),
            file_hash(folder / "in.exr"));
}

TEST(Render, NonfiniteColours) {
  const Folder folder;
  const Size size{9, 5};
  Plane bad(45, 0.5f);
  bad[22] = NAN;
  bad[3] = INFINITY;
  ImageFile::from_planes({"R", "G", "B", "Z"},
                         {bad, Plane(45, 0.5f), Plane(45, 0.5f), random_depth(size, 2)}, 9, 5)
      .write(folder / "in.exr");
  const Result zero = defray(folder, "render in.exr -o out.exr" + lens);
  expect_ok(zero);
  EXPECT_NE(zero.out.find("2 NaN or Inf colour values set to 0"), std::string::npos) << zero.out;
  for (const float v : ImageFile::read(folder / "out.exr").plane(0, 0))
    EXPECT_TRUE(std::isfinite(v));
  expect_ok(defray(folder, "render in.exr -o out.exr --nonfinite keep" + lens));
  std::size_t kept = 0;
  for (const float v : ImageFile::read(folder / "out.exr").plane(0, 0)) kept += !std::isfinite(v);
  EXPECT_GT(kept, 0u);
  const Result error = defray(folder, "render in.exr -o none.exr --nonfinite error" + lens);
  EXPECT_EQ(error.code, 3);
  EXPECT_NE(error.err.find("(3, 0)"), std::string::npos) << error.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
}

}  // namespace
}  // namespace defray::test::render_command_test
