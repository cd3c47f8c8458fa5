// Files that are damaged, disks and memory that are full: what failed is said, and of which file.
#include <dlfcn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include "image/image_file.h"
#include "image/ldr.h"
#include "image/safe_output.h"
#include "support.h"

namespace defray::test::failing_files_test {
namespace {

/// While it lives this process may not have more of a resource.
class Limit {
 public:
  Limit(__rlimit_resource resource, rlim_t most) : resource_(resource) {
    getrlimit(resource_, &before_);
    const rlimit less{most, before_.rlim_max};
    setrlimit(resource_, &less);
  }
  ~Limit() { setrlimit(resource_, &before_); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

 private:
  __rlimit_resource resource_;
  rlimit before_{};
};

/// While it lives files hold 1 KiB, as if a disk were full.
class FullDisk {
 public:
  ~FullDisk() { std::signal(SIGXFSZ, before_); }

 private:
  void (*before_)(int) = std::signal(SIGXFSZ, SIG_IGN);  // write() fails instead
  Limit limit_{RLIMIT_FSIZE, 1024};
};

ImageFile noise(int width, int height) {
  const Size size{width, height};
  return ImageFile::from_planes(
      {"R", "G", "B"}, {random_plane(size, 1), random_plane(size, 2), random_plane(size, 3)}, width,
      height, Sample::single_float);
}

std::string bytes_of(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void expect_unreadable(const std::string& path, const std::vector<std::string>& words) {
  expect_error(ErrorKind::input, words, [&] { ImageFile::read(path); });
}

TEST(FailingFiles, OfAPictureThatWasCutOffThePixelsAreMissed) {
  const Folder folder;
  noise(64, 64).write(folder / "in.exr");
  const std::string whole = bytes_of(folder / "in.exr");
  write_bytes(folder / "cut.exr", whole.substr(0, whole.size() / 2));
  expect_unreadable(folder / "cut.exr", {"cut.exr: cannot read its pixels: "});
}

TEST(FailingFiles, MoviesAreNoPictures) {
  const Folder folder;
  for (const std::string name : {"a.avi", "a.mpg", "a.mp4"}) {
    write_bytes(folder / name, "RIFF");
    expect_unreadable(folder / name, {name + ": is a movie; allowed are pictures, a file a frame"});
  }
}

TEST(FailingFiles, JpegsAndPngsThatOpenCvCannotUse) {
  const Folder folder;
  write_ldr(folder / "a.jpg", {8, 8, {"R", "G", "B"}, std::vector<Plane>(3, Plane(64, 0.5f))});
  std::string bytes = bytes_of(folder / "a.jpg");
  const std::size_t frame = bytes.find("\xff\xc0");  // its length, bits, height and width follow
  ASSERT_NE(frame, bytes.npos);
  bytes.replace(frame + 5, 4, "\xea\x60\xea\x60");  // 60000x60000
  write_bytes(folder / "large.jpg", bytes);
  expect_unreadable(folder / "large.jpg", {"large.jpg: not a readable image: ", "pixels"});
  write_bytes(folder / "cut.png", "\x89PNG\r\n\x1a\n");
  expect_unreadable(folder / "cut.png", {"cut.png: not a readable image (damaged or truncated)"});
  write_bytes(folder / "float.png", "PF\n1 1\n-1.0\n" + std::string(12, '\0'));  // a PFM
  expect_unreadable(folder / "float.png", {"float.png: neither 8 nor 16 bits a channel"});
}

TEST(FailingFiles, APictureThatMemoryDoesNotHoldIsNamed) {
  // Allocating fails there, instead of throwing.
  for (const char* sanitizer : {"__asan_init", "__tsan_init"}) {
    if (dlsym(RTLD_DEFAULT, sanitizer)) GTEST_SKIP() << "under a sanitizer";
  }
  const Folder folder;
  ImageFile::from_planes({"Y"}, {Plane(64, 1.0f)}, 8, 8, Sample::single_float)
      .write(folder / "a.exr");
  std::string bytes = bytes_of(folder / "a.exr") + std::string(1 << 16, '\0');
  const std::int32_t last[] = {15999, 15999};
  for (const std::string name : {"dataWindow", "displayWindow"}) {
    const std::size_t at = bytes.find(name + std::string("\0box2i\0", 7));
    ASSERT_NE(at, bytes.npos);
    std::memcpy(&bytes[at + name.size() + 7 + 4 + 8], last, sizeof(last));
  }
  write_bytes(folder / "large.exr", bytes);
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const Limit limit(RLIMIT_AS, pages * static_cast<rlim_t>(getpagesize()) + (rlim_t{512} << 20));
  expect_unreadable(folder / "large.exr", {"large.exr: not enough memory to read it"});
}

TEST(FailingFiles, OnAFullDiskNoFormatIsWritten) {
  const Folder folder;
  const ImageFile file = noise(64, 64);
  const LdrPicture picture{
      64, 64, {"R", "G", "B"}, {file.plane(0, 0), file.plane(0, 1), file.plane(0, 2)}};
  const auto expect_unwritable = [&](const std::string& name, const std::string& why,
                                     const std::function<void(const std::string&)>& write) {
    const FullDisk full;
    expect_error(ErrorKind::output, {name + ": cannot write" + why}, [&] { write(folder / name); });
  };
  const std::string too_large = std::string(": ") + std::strerror(EFBIG);
  for (const char* name : {"a.exr", "a.tif", "a.hdr"}) {
    expect_unwritable(name, ": ", [&](const std::string& path) { file.write(path); });
  }
  expect_unwritable("a.png", too_large, [&](const std::string& p) { write_ldr(p, picture); });
  expect_unwritable("a.txt", "",
                    [](const std::string& p) { write_text(p, std::string(4096, 'a')); });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST(FailingFiles, WhatAFormatCannotHoldIsSaid) {
  const Folder folder;
  expect_error(ErrorKind::output, {"a.xyz: unknown image format: ", "xyz"},
               [&] { noise(4, 4).write(folder / "a.xyz"); });
  const int width = 65501;  // JPEG holds one less
  const LdrPicture wide{width, 1, {"R", "G", "B"}, std::vector<Plane>(3, Plane(size(width)))};
  expect_error(ErrorKind::output, {"a.jpg: cannot encode 65501x1 pixels: "},
               [&] { write_ldr(folder / "a.jpg", wide); });
  write_ldr(folder / "a.png", wide);
  EXPECT_EQ(read_ldr(folder / "a.png", Content::data).width, width);
}

TEST(FailingFiles, WhatCannotTakeItsNameIsRemoved) {
  const Folder folder;
  expect_error(ErrorKind::output, {"a.txt: cannot sync it to disk: ", std::strerror(ENOENT)},
               [&] { write_safely(folder / "a.txt", [](const std::string&) {}); });
  std::filesystem::create_directory(folder / "b.txt");  // since it was looked whether one can write
  expect_error(ErrorKind::output,
               {"b.txt: cannot rename the finished file to it: ", std::strerror(EISDIR)},
               [&] { write_text(folder / "b.txt", "text"); });
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace defray::test::failing_files_test
