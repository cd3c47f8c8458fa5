// The program in awkward places: cold and unwritable kernel caches, no device, no display, a full
// disk, signals, huge frames.
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::environment_test {
namespace {

TEST(Devices, ListsInTextAndJson) {
  const Folder folder;
  const Result text = defray(folder, "devices");
  EXPECT_EQ(text.code, 0) << text.err;
  const auto list = nlohmann::json::parse(defray(folder, "devices --json").out);
  ASSERT_GE(list.size(), 1u);
  EXPECT_TRUE(list[0].contains("int64_atomics"));
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto count = [&](const char* key) {
      const auto value = list[i][key].get<std::size_t>();
      EXPECT_GT(value, 0u) << key;
      return value;
    };
    for (const std::string& line :
         {fmt::format("{}: {}\n", i, list[i]["name"].get<std::string>()),
          fmt::format(", {} compute units, work-groups up to {}\n", count("compute_units"),
                      count("max_work_group")),
          fmt::format("memory      {} MiB, largest buffer {} MiB, local {} KiB\n",
                      count("global_memory_bytes") / 1048576, count("max_buffer_bytes") / 1048576,
                      count("local_memory_bytes") / 1024),
          fmt::format("64-bit atomics {}, double {}\n",
                      list[i]["int64_atomics"] ? "yes" : "no (two-pass scatter)",
                      list[i]["double"] ? "yes" : "no")}) {
      EXPECT_NE(text.out.find(line), std::string::npos) << line << " in " << text.out;
    }
  }
}

TEST(Devices, CanBeChosenByIndexAndNamePart) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  for (const char* name : {"0", "portable", "PTHREAD"}) {
    const Result result =
        defray(folder, "render in.exr -o out.exr --device " + std::string(name) + lens);
    EXPECT_EQ(result.code, 0) << name << ": " << result.err;
  }
}

TEST(Devices, NoneIsAnErrorThatNamesThePackage) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  const std::string none = "OCL_ICD_VENDORS='" + folder.path() + "'";
  for (const std::string& command : {"render in.exr -o out.exr" + lens, std::string("devices")}) {
    const Result result = defray(folder, command, none);
    EXPECT_EQ(result.code, 5);
    EXPECT_NE(result.err.find("pocl-opencl-icd"), std::string::npos) << result.err;
  }
  // The scalar twin needs no device.
  EXPECT_EQ(defray(folder, "render in.exr -o out.exr --device reference" + lens, none).code, 0);
}

TEST(KernelCache, UnwritableFallsBackToAPrivateOne) {
  SKIP_UNLESS_FULL();
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  std::ofstream(folder / "file") << "no folder";
  // Not even root can make a folder inside a file.
  const std::string home = "env -u XDG_CACHE_HOME HOME='" + (folder / "file") + "'";
  const std::string variables[] = {"POCL_CACHE_DIR='" + (folder / "file") + "'",
                                   "XDG_CACHE_HOME='" + (folder / "file") + "'", home};
  for (const std::string& variable : variables) {
    const std::string temporary = " TMPDIR='" + folder.path() + "'";
    const Result result = defray(folder, "render in.exr -o out.exr" + lens,
                                 (variable == home ? variable : "env " + variable) + temporary);
    EXPECT_EQ(result.code, 0) << variable << ": " << result.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      EXPECT_EQ(entry.path().filename().string().find("defray-kcache"), std::string::npos);
    }
  }
}

TEST(KernelCache, ThatOfAKilledRunGoesWithTheNext) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  std::ofstream(folder / "file") << "no folder";
  std::filesystem::create_directories(folder / "tmp/defray-kcache-999999999-abcdef/some");
  expect_ok(
      defray(folder, "render in.exr -o out.exr --method linear" + lens,
             "env POCL_CACHE_DIR='" + (folder / "file") + "' TMPDIR='" + (folder / "tmp") + "'"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

TEST(KernelCache, ParallelProcessesOnAColdCacheAllSucceed) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  // They fight over the program, which all methods share: the one with the fewest kernels will do.
  const int rounds = takes_long_tests() ? 4 : 1, processes = takes_long_tests() ? 6 : 3;
  for (int round = 0; round < rounds; ++round) {
    const std::string cache = folder / ("cache" + std::to_string(round));
    std::string command = "export POCL_CACHE_DIR='" + cache + "'; pids=; ";
    for (int i = 0; i < processes; ++i) {
      command += program() + " render in.exr -q --method linear -o out" + std::to_string(i) +
                 ".exr" + lens + "& pids=\"$pids $!\"; ";
    }
    command += "bad=0; for p in $pids; do wait $p || bad=1; done; exit $bad";
    const Result result = shell(folder, "(" + command + ")");
    EXPECT_EQ(result.code, 0) << "round " << round << ": " << result.err;
    EXPECT_EQ(result.err, "") << "of compilers, too";
  }
}

TEST(Show, IsSkippedWithoutADisplay) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"});
  const Result none =
      defray(folder, "render in.exr -o out.exr --show" + lens, "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(none.code, 0);
  EXPECT_NE(none.err.find("--show skipped: neither DISPLAY"), std::string::npos) << none.err;
  const Result dead = defray(folder, "render in.exr -o out.exr --show" + lens,
                             "env -u WAYLAND_DISPLAY DISPLAY=:397");
  EXPECT_EQ(dead.code, 0);
  EXPECT_NE(dead.err.find("no X server answers"), std::string::npos) << dead.err;
}

TEST(Output, FullDiskLeavesTheOldFile) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to mount a small file system";
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}, {320, 200});
  std::filesystem::create_directory(folder / "disk");
  if (shell(folder, "mount -t tmpfs -o size=64k tmpfs disk").code != 0) {
    GTEST_SKIP() << "cannot mount here";
  }
  std::ofstream(folder / "disk/out.exr") << "old";
  const Result exr = defray(folder, "render in.exr -o disk/out.exr" + lens);
  const Result png = defray(folder, "render in.exr -o disk/out.png" + lens);
  const std::string left = shell(folder, "ls -A disk; cat disk/out.exr").out;
  shell(folder, "umount disk");
  EXPECT_EQ(exr.code, 4) << exr.err;
  EXPECT_EQ(png.code, 4) << png.err;
  EXPECT_NE(exr.err.find("out.exr"), std::string::npos) << exr.err;
  EXPECT_EQ(left, "out.exr\nold");
}

TEST(Output, InterruptedRunLeavesNothingBehind) {
  const Folder folder;
  write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}, {640, 480});
  std::filesystem::create_directory(folder / "out");
  for (const char* delay : {"0.1", "0.3", "0.6"}) {
    const Result result =
        shell(folder, "timeout --preserve-status -s INT " + std::string(delay) + " " + program() +
                          " render in.exr -o out/o.exr --rdb 33" + lens);
    if (result.code == 0) continue;
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_EQ(shell(folder, "ls -A out").out, "");
  }
}

TEST(Help, ShowsUnitsDefaultsAndExamples) {
  const Folder folder;
  const Result top = defray(folder, "--help");
  EXPECT_EQ(top.code, 0);
  for (const char* word : {"render", "devices", "Examples", "Exit codes"}) {
    EXPECT_NE(top.out.find(word), std::string::npos) << word;
  }
  const Result render = defray(folder, "render --help");
  EXPECT_EQ(render.code, 0);
  for (const char* word :
       {"--focus", "mm", "px", "Examples", "default 9", "default 512", "Units"}) {
    EXPECT_NE(render.out.find(word), std::string::npos) << word << "\n" << render.out;
  }
  for (const std::string command : {"compare", "sheet", "scene", "validate", "psf", "trade"}) {
    const std::string help = defray(folder, command + " --help").out;
    EXPECT_NE(help.find("; default "), std::string::npos) << help;
    for (const char* other : {"TEXT=", "INT=", "FLOAT=", "default []"}) {
      EXPECT_EQ(help.find(other), std::string::npos) << command << ": " << other;
    }
  }
  EXPECT_EQ(defray(folder, "--version").code, 0);
  EXPECT_EQ(defray(folder, "").code, 2);
}

}  // namespace
}  // namespace defray::test::environment_test
