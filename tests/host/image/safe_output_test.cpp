// Files are written beside and renamed: what is left of them, whatever happens.
#include "image/safe_output.h"

#include <grp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/input_file.h"
#include "support.h"

namespace defray::test::safe_output_test {
namespace {

TEST(SafeOutput, WritesThroughALink) {
  const Folder folder;
  std::ofstream(folder / "real.txt") << "old";
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_safely(folder / "link.txt", [](const std::string& name) { std::ofstream(name) << "new"; });
  EXPECT_EQ(text_of(folder / "real.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
}

TEST(SafeOutput, NamesMayBeAsLongAsTheSystemHasThem) {
  const Folder folder;
  for (const std::size_t length : {200, 240, 255}) {
    const std::string a = folder / (std::string(length - 5, 'x') + "a.exr");
    const std::string b = folder / (std::string(length - 5, 'x') + "b.exr");
    write_safely(a, [&](const std::string& first) {
      std::ofstream(first) << "a";
      write_safely(b, [&](const std::string& second) {
        EXPECT_NE(first, second);
        std::ofstream(second) << "b";
      });
    });
    EXPECT_EQ(text_of(a), "a");
    EXPECT_EQ(text_of(b), "b");
  }
}

/// As the signal handler does it, of all that are being written.
TEST(SafeOutput, AnInterruptedWriteOfManyLeavesNothing) {
  const Folder folder;
  std::vector<std::jthread> writers;
  std::atomic<int> ready = 0;
  std::atomic<bool> go_on = false;
  for (int i = 0; i < 5; ++i) {
    writers.emplace_back([&, i] {
      const std::string path = folder / fmt::format("{}.txt", i);
      EXPECT_THROW(write_safely(path,
                                [&](const std::string& name) {
                                  std::ofstream(name) << i;
                                  ++ready;
                                  while (!go_on) std::this_thread::yield();
                                }),
                   Error);
    });
  }
  while (ready < 5) std::this_thread::yield();
  remove_temporary();
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  go_on = true;
}

TEST(SafeOutput, ALinkMayNameAFileThatIsYetToCome) {
  const Folder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/second", folder / "first");
  std::filesystem::create_symlink("../new.txt", folder / "there/second");
  check_can_write(folder / "first");
  write_text(folder / "first", "new");
  EXPECT_EQ(text_of(folder / "new.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "there/second"));
  std::filesystem::create_symlink("none/new.txt", folder / "lost");
  expect_error(ErrorKind::output, {"cannot write in folder", "none"},
               [&] { check_can_write(folder / "lost"); });
}

TEST(SafeOutput, FailureLeavesTheOldFileAndNothingElse) {
  const Folder folder;
  std::ofstream(folder / "out.txt") << "old";
  expect_error(ErrorKind::output, {"out.txt", "broken"}, [&] {
    write_safely(folder / "out.txt", [](const std::string& name) {
      std::ofstream(name) << "half";
      fail(ErrorKind::output, "{}: broken", name);
    });
  });
  EXPECT_EQ(text_of(folder / "out.txt"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(SafeOutput, UnwritablePlacesAreFoundEarly) {
  const Folder folder;
  expect_error(ErrorKind::output, {"cannot write in folder"},
               [&] { check_can_write(folder / "no/such/out.exr"); });
  expect_error(ErrorKind::output, {"cannot write in folder"},
               [] { check_can_write("/proc/out.exr"); });
  expect_error(ErrorKind::output, {"is a folder"}, [&] { check_can_write(folder.path()); });
  expect_error(ErrorKind::output, {"cannot write in folder", "too long"},
               [&] { check_can_write(folder / (std::string(300, 'a') + ".exr")); });
}

TEST(SafeOutput, AWriteProtectedFileIsNotReplaced) {
  const Folder folder;
  const std::string path = folder / "kept.txt";
  std::ofstream(path) << "old";
  std::filesystem::create_symlink("kept.txt", folder / "link.txt");
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  for (const std::string& name : {path, folder / "link.txt"}) {  // root is told, too
    const std::vector<std::string> words{name + ": is write-protected; allow writing it (chmod"};
    expect_error(ErrorKind::output, words, [&] { check_can_write(name); });
    expect_error(ErrorKind::output, words, [&] { check_can_make(name); });
    expect_error(ErrorKind::output, words, [&] { write_text(name, "new"); });
  }
  EXPECT_EQ(text_of(path), "old");
  std::filesystem::permissions(path, std::filesystem::perms(0200));
  write_text(path, "new");
  std::filesystem::permissions(path, std::filesystem::perms(0600));
  EXPECT_EQ(text_of(path), "new");
}

/// What a user who is neither the file's owner nor of its group is told; empty: nothing.
std::string said_to_another(const Folder& folder, const std::string& path) {
  const std::string told = folder / "told.txt";
  const pid_t child = fork();
  if (child == 0) {
    constexpr unsigned nobody = 65534;
    const bool is_root = geteuid() == 0;
    if (is_root && (setgroups(0, nullptr) != 0 || setgid(nobody) != 0 || setuid(nobody) != 0)) {
      _exit(1);
    }
    try {
      check_can_write(path);
    } catch (const Error& error) {
      std::ofstream(told) << error.what();
    }
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  return std::filesystem::exists(told) ? text_of(told) : "";
}

TEST(SafeOutput, AFileOfAnotherUserIsNotReplaced) {
  const Folder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
  const std::string path = folder / "theirs.txt";
  std::ofstream(path) << "old";
  std::filesystem::permissions(path, std::filesystem::perms(0464));  // the owner, too, may not
  const std::string said = said_to_another(folder, path);
  EXPECT_NE(said.find("theirs.txt: is write-protected; allow"), std::string::npos) << said;
  std::filesystem::remove(folder / "told.txt");
  std::filesystem::permissions(path, std::filesystem::perms(0666));
  EXPECT_EQ(said_to_another(folder, path), "");
}

}  // namespace
}  // namespace defray::test::safe_output_test
