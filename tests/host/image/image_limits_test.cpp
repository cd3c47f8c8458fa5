// How large pictures may be: up to the limit they are read, one more is refused by its header.
#include <numeric>

#include "image/image_file.h"
#include "image/ldr.h"
#include "support.h"

namespace defray::test::image_limits_test {
namespace {

std::string write_sized(const Folder& folder, int width, int height, int channels) {
  const std::string path = folder / "sized.exr";
  std::vector<std::string> names;
  std::vector<Plane> planes;
  for (int c = 0; c < channels; ++c) {
    names.push_back(fmt::format("c{:05}", c));
    planes.emplace_back(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), c);
  }
  ImageFile::from_planes(names, planes, width, height).write(path);
  return path;
}

TEST(ImageLimits, SidesAreUpTo65536Pixels) {
  const Folder folder;
  for (const auto& [width, height] : {std::pair{65536, 1}, {1, 65536}}) {
    const ImageFile file = ImageFile::read(write_sized(folder, width, height, 1));
    EXPECT_EQ(file.parts()[0].data, (Window{0, 0, width, height}));
  }
  for (const auto& [width, height] : {std::pair{65537, 1}, {1, 65537}}) {
    const std::string path = write_sized(folder, width, height, 1);
    expect_error(ErrorKind::input, {fmt::format("{}x{}x1", width, height), "1 to 65536 a side"},
                 [&] { ImageFile::read(path); });
  }
}

TEST(ImageLimits, SidesOfPngsToo) {
  const Folder folder;
  write_ldr(folder / "wide.png", {65537, 1, {"Y"}, {Plane(65537)}});
  expect_error(ErrorKind::input, {"wide.png: has 65537x1 pixels", "1 to 65536 a side"},
               [&] { ImageFile::read(folder / "wide.png"); });
}

TEST(ImageLimits, ChannelsAreUpTo4096) {
  const Folder folder;
  const ImageFile file = ImageFile::read(write_sized(folder, 1, 1, 4096));
  ASSERT_EQ(file.parts()[0].channels.size(), 4096u);
  EXPECT_EQ(file.plane(0, 2000)[0], 2000);
  const std::string path = write_sized(folder, 1, 1, 4097);
  expect_error(ErrorKind::input, {"4097 channels", "1 to 4096"}, [&] { ImageFile::read(path); });
}

}  // namespace
}  // namespace defray::test::image_limits_test
