// defray render: other formats than EXR, and what is lost in them.
#include <OpenImageIO/imagebuf.h>

#include "command/program.h"
#include "image/ldr.h"

namespace defray::test::formats_command_test {
namespace {

TEST(RenderFormats, OtherThanExr) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "A", "Z"});
  for (const std::string format : {"png", "jpg", "tif", "hdr"}) {
    expect_ok(defray(folder, "render in.exr -o out." + format + lens));
    const ImageFile out = ImageFile::read(folder / ("out." + format));
    EXPECT_EQ(out.parts()[0].data.width, 48) << format;
  }
  // A display-encoded picture with depth from elsewhere, and back to EXR.
  expect_ok(defray(folder, "render out.png --depth in.exr -o again.png" + lens));
  expect_ok(defray(folder, "render out.png --depth in.exr -o again.exr" + lens));
  const Result bad = defray(folder, "render in.exr -o out.gif" + lens);
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("'.gif'"), std::string::npos) << bad.err;
}

TEST(RenderFormats, NotesSayWhatIsLost) {
  const Folder folder;
  const Plane grey(64, 0.5f), bright(64, 2.0f), z(64, 5.0f);
  const auto note = [&](const std::string& file, const std::string& options) {
    const Result result = defray(folder, "render " + file + " -o " + options + lens);
    expect_ok(result);
    return result.out;
  };
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, z}, 8, 8).write(folder / "a.exr");
  ImageFile::from_planes({"R", "G", "B", "Z"}, {bright, grey, grey, z}, 8, 8)
      .write(folder / "b.exr");
  EXPECT_EQ(note("a.exr", "o.png").find("clipped"), std::string::npos);
  EXPECT_NE(note("b.exr", "o.png").find("64 values outside 0...1 clipped"), std::string::npos);
  EXPECT_NE(note("a.exr", "o.png").find("only colour is written"), std::string::npos);
  EXPECT_EQ(note("o.png", "p.tif --depth a.exr").find("only colour"), std::string::npos);
  EXPECT_NE(note("a.exr", "c.exr --depth-kind normalized --near 1 --far 2")
                .find("64 stored depths lie outside 0...1"),
            std::string::npos);
  OIIO::ImageBuf aside(folder / "a.exr");
  aside.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  aside.specmod().x = 20;
  aside.write(folder / "aside.exr");
  EXPECT_NE(note("aside.exr", "e.exr").find("8x8+20+0 lies outside the display window 8x8+0+0"),
            std::string::npos);
  EXPECT_EQ(note("a.exr", "e.exr").find("lies outside the"), std::string::npos);
  OIIO::ImageBuf lossy(folder / "a.exr");
  lossy.read(0, 0, true, OIIO::TypeDesc::HALF);
  lossy.specmod().attribute("compression", "dwaa:45");
  lossy.write(folder / "dwa.exr");
  EXPECT_NE(note("dwa.exr", "d.exr").find("lossy"), std::string::npos);
}

TEST(RenderFormats, GreyStaysGrey) {
  const Folder folder;
  write_picture_file(folder, "z.exr", {"Z"});
  Plane grey(48 * 32);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<float>(i % 97) / 96;
  write_ldr(folder / "grey.png", {48, 32, {}, {grey}, 8});
  write_ldr(folder / "deep.png", {48, 32, {}, {grey}, 16});
  write_ldr(folder / "grey.jpg", {48, 32, {}, {grey}, 8});
  write_ldr(folder / "rgb.png", {48, 32, {}, {grey, grey, grey}, 8});
  const auto stored = [&](const std::string& in, const std::string& out) {
    const std::string name = in + "." + out;
    expect_ok(defray(folder, "render " + in + " --depth z.exr -o " + name + lens));
    const OIIO::ImageBuf file(folder / name);
    return fmt::format("{} {}", file.nchannels(), file.spec().format.c_str());
  };
  EXPECT_EQ(stored("grey.png", "png"), "1 uint8");
  EXPECT_EQ(stored("deep.png", "png"), "1 uint16");
  EXPECT_EQ(stored("grey.png", "jpg"), "1 uint8");
  EXPECT_EQ(stored("grey.jpg", "png"), "1 uint8");
  EXPECT_EQ(stored("deep.png", "tif"), "1 uint16");
  EXPECT_EQ(stored("grey.png", "exr"), "1 half");
  EXPECT_EQ(stored("grey.png", "hdr"), "3 float");
  EXPECT_EQ(stored("rgb.png", "png"), "3 uint8");
  // The same picture.
  const LdrPicture one = read_ldr(folder / "grey.png.png");
  const LdrPicture three = read_ldr(folder / "rgb.png.png");
  EXPECT_EQ(one.channels, std::vector<std::string>{"Y"});
  for (const Plane& plane : three.planes) EXPECT_EQ(plane, one.planes[0]);
  // With an alpha: PNG has it beside R, G and B, JPEG leaves it out.
  write_picture_file(folder, "ya.exr", {"Y", "A"});
  EXPECT_EQ(stored("ya.exr", "png"), "4 uint8");
  EXPECT_EQ(stored("ya.exr", "jpg"), "1 uint8");
}

TEST(RenderFormats, LinearAndDisplayEncodedInputsAgree) {
  const Folder folder;
  expect_ok(defray(folder, "scene plate1 -o . --width 64 --height 48 --truth-samples 1"));
  expect_ok(
      defray(folder, "render pinhole.exr -o sharp.png --camera camera.json --aperture-diameter 0"));
  expect_ok(defray(folder, "render pinhole.exr -o a.exr --camera camera.json"));
  expect_ok(defray(folder, "render sharp.png --depth pinhole.exr -o b.exr --camera camera.json"));
  expect_ok(defray(folder, "compare a.exr b.exr --min-psnr 50"));  // 8 bits are 59 dB at best
  for (const std::string jpeg : {"sharp.jpg", "sharp.JPEG"}) {
    expect_ok(defray(
        folder, "render pinhole.exr -o " + jpeg + " --camera camera.json --aperture-diameter 0"));
    expect_ok(defray(folder, "compare " + jpeg + " sharp.png --min-psnr 30"));
    expect_ok(defray(folder, "render " + jpeg +
                                 " --depth pinhole.exr -o c.exr "
                                 "--camera camera.json"));
    expect_ok(defray(folder, "compare a.exr c.exr --min-psnr 30"));
  }
}

TEST(RenderFormats, AFormatThatTheNameDoesNotSay) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  for (const std::string format : {"png", "jpg", "tif", "hdr"}) {
    expect_ok(defray(folder, "render in.exr -o in." + format + lens));
  }
  const auto named = [&](const std::string& file, const std::string& name) {
    expect_ok(shell(folder, "cp " + file + " " + name));
    return defray(folder, "render " + name + " --depth in.exr -o o.exr" + lens);
  };
  const auto refused = [&](const std::string& file, const std::string& name,
                           const std::string& what) {
    expect_refusal(named(file, name), 3, {name + ": is " + what}, name);
  };
  refused("in.exr", "wrong.png", "an OpenEXR file by its content: name it .exr\n");
  refused("in.tif", "wrong.jpg", "a TIFF file by its content: name it .tif\n");
  refused("in.hdr", "wrong.jpeg", "a Radiance HDR file by its content: name it .hdr\n");
  refused("in.png", "wrong.exr", "a PNG file by its content: name it .png\n");
  refused("in.jpg", "wrong.tif", "a JPEG file by its content: name it .jpg\n");
  // Where nothing is read otherwise.
  expect_ok(named("in.exr", "picture"));
  expect_ok(named("in.jpg", "right.png"));
  expect_ok(named("in.tif", "right.exr"));
}

}  // namespace
}  // namespace defray::test::formats_command_test
