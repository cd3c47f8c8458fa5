// What of a file stays that another takes the place of, and what of a texture.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "image/image_file.h"
#include "image/output.h"
#include "image/safe_output.h"
#include "support.h"

namespace defray::test::replaced_files_test {
namespace {

TEST(ImageFile, OfATextureTheLargestLevelIsReadAndWritten) {
  const Folder folder;
  const std::vector<Plane> planes{random_plane({96, 80}, 1), random_plane({96, 80}, 2)};
  ImageFile::from_planes({"R", "Z"}, planes, 96, 80, Sample::single_float).write(folder / "in.exr");
  EXPECT_FALSE(ImageFile::read(folder / "in.exr").has_smaller_levels());
  ASSERT_TRUE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture,
                                               OIIO::ImageBuf(folder / "in.exr"),
                                               folder / "texture.exr", OIIO::ImageSpec()));
  ImageFile texture = ImageFile::read(folder / "texture.exr");
  std::vector<std::string> notes;
  write_picture(folder / "out.exr", texture, {0, "", "", {0}}, {planes[1]}, Bits::as_input, notes);
  EXPECT_EQ(
      notes,
      (std::vector<std::string>{"is a texture: its largest MIP level alone is read and written"}));
  const auto out = OIIO::ImageInput::open(folder / "out.exr");
  EXPECT_FALSE(out->seek_subimage(0, 1));
  for (const char* stale : {"oiio:SHA-1", "oiio:AverageColor", "textureformat"}) {
    EXPECT_EQ(out->spec(0).find_attribute(stale), nullptr) << stale;
  }
  EXPECT_EQ(ImageFile::read(folder / "out.exr").plane(0, 0), planes[1]);
}

TEST(ImageFile, AnEnvironmentStaysOne) {
  const Folder folder;
  OIIO::ImageSpec spec(64, 32, 1, OIIO::TypeDesc::HALF);
  spec.channelnames = {"R"};
  spec.attribute("textureformat", "LatLong Environment");
  ASSERT_TRUE(OIIO::ImageBuf(spec).write(folder / "in.exr"));
  const ImageFile in = ImageFile::read(folder / "in.exr");
  EXPECT_FALSE(in.has_smaller_levels());
  in.write(folder / "out.exr");
  const auto out = OIIO::ImageInput::open(folder / "out.exr");
  EXPECT_EQ(out->spec().get_string_attribute("textureformat"), "LatLong Environment");
}

TEST(SafeOutput, KeepsPermissionsAndReplacesNoPipe) {
  namespace fs = std::filesystem;
  const Folder folder;
  write_text(folder / "a.txt", "before");
  const auto own = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(folder / "a.txt", own);
  write_text(folder / "a.txt", "after");
  EXPECT_EQ(fs::status(folder / "a.txt").permissions(), own);
  std::string text;
  std::ifstream(folder / "a.txt") >> text;
  EXPECT_EQ(text, "after");
  ASSERT_EQ(mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
  expect_error(ErrorKind::output, {"pipe.exr: is a pipe or a device", "name a file"},
               [&] { check_can_write(folder / "pipe.exr"); });
  expect_error(ErrorKind::output, {"pipe.exr: is a pipe or a device", "name a file"},
               [&] { write_text(folder / "pipe.exr", "after"); });
  EXPECT_TRUE(fs::is_fifo(folder / "pipe.exr"));
}

}  // namespace
}  // namespace defray::test::replaced_files_test
