// A picture's file through the API: what is written is what was given.
#include "defray/io.h"
#include "image/image_file.h"
#include "support.h"

namespace defray::test::picture_file_test {
namespace {

TEST(PictureFile, WritesColourAndPlanesAsGiven) {
  const Folder folder;
  const Size size{9, 5};
  const Plane grey = random_plane(size, 1), depth(size.width * size.height, 2.0f);
  ImageFile::from_planes({"R", "G", "B", "Z"}, {grey, grey, grey, depth}, 9, 5,
                         Sample::single_float)
      .write(folder / "in.exr");
  PictureFile file = PictureFile::read(folder / "in.exr");
  const Plane other = random_plane(size, 2);
  EXPECT_TRUE(file.write(folder / "out.exr", {other, grey, other}).empty());
  const ImageFile out = ImageFile::read(folder / "out.exr");
  const std::vector<Plane> expected{other, grey, other, depth};
  for (int c = 0; c < 4; ++c)
    EXPECT_EQ(hash_of({out.plane(0, c)}), hash_of({expected[static_cast<std::size_t>(c)]})) << c;
  file.write_plane(folder / "data.exr", "confidence", other);
  const ImageFile data = ImageFile::read(folder / "data.exr");
  EXPECT_EQ(data.parts()[0].channels, std::vector<std::string>{"confidence"});
  EXPECT_EQ(hash_of({data.plane(0, 0)}), hash_of({other}));
}

}  // namespace
}  // namespace defray::test::picture_file_test
