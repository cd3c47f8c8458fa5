// The whole API once more, in a program that mutants and sanitizers reach: library_test.sh runs the
// same on the installed library.
#define main api_main
#include "library/api.cpp"
#undef main

#include "image/image_file.h"
#include "support.h"

namespace defray::test::api_test {
namespace {

TEST(Api, IsAsItsHeadersSay) {
  const Folder folder;
  const Size size{48, 32};
  std::string input = folder / "in.exr", output = folder.path(), own_version = version();
  ImageFile::from_planes(
      {"R", "G", "B", "Z"},
      {random_plane(size, 1), random_plane(size, 2), random_plane(size, 3), random_depth(size, 4)},
      size.width, size.height, Sample::single_float)
      .write(input);
  char program[] = "api";
  char* arguments[] = {program, input.data(), output.data(), own_version.data(), nullptr};
  EXPECT_EQ(api_main(4, arguments), 0);
}

}  // namespace
}  // namespace defray::test::api_test
