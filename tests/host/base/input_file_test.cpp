// Files that are read: what is said of those that are not.
#include "base/input_file.h"

#include <filesystem>
#include <fstream>
#include <functional>

#include "image/image_file.h"
#include "lens/camera.h"
#include "support.h"

namespace defray::test::input_file_test {
namespace {

TEST(InputFile, SaysWhyItCannotBeRead) {
  const Folder folder;
  const std::string loop = folder / "loop.exr";
  std::filesystem::create_symlink("loop.exr", loop);
  std::ofstream(folder / "file") << "two\nlines";
  EXPECT_EQ(defray::text_of(folder / "file"), "two\nlines");
  const std::function<void(const std::string&)> readers[] = {
      [](const std::string& path) { ImageFile::read(path); },
      [](const std::string& path) { open_input(path); },
      [](const std::string& path) { defray::text_of(path); },
      [](const std::string& path) { read_camera_json(path, "", 1); }};
  for (const auto& read : readers) {
    expect_error(ErrorKind::input, {"loop.exr: cannot be read: Too many levels"},
                 [&] { read(loop); });
    expect_error(ErrorKind::input, {"is a folder, not a file"}, [&] { read(folder.path()); });
    for (const std::string missing : {"none.exr", "file/none.exr"}) {
      expect_error(ErrorKind::input, {missing + ": no such file"}, [&] { read(folder / missing); });
    }
  }
}

}  // namespace
}  // namespace defray::test::input_file_test
