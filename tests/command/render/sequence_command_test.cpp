// defray render over sequences: frames found, skipped, failed, reported.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command/program.h"

namespace defray::test::sequence_command_test {
namespace {

TEST(Sequence, JsonLinesAreJson) {
  const Folder folder;
  write_picture_file(folder, "s.0001.exr", {"R", "G", "B", "Z"});
  write_picture_file(folder, "s.0003.exr", {"R", "G", "B", "Z"});
  const Result result = defray(
      folder, "render 's.####.exr' -o 'o.####.exr' --frames 1-3 --json --skip-bad-frames" + lens);
  EXPECT_EQ(result.code, 1);
  std::istringstream lines(result.out);
  std::vector<nlohmann::json> frames;
  for (std::string line; std::getline(lines, line);) frames.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0]["status"], "ok");
  EXPECT_EQ(frames[0]["depth_channel"], "Z");
  EXPECT_EQ(frames[1]["status"], "failed");
  EXPECT_NE(frames[1]["error"].get<std::string>().find("s.0002.exr"), std::string::npos);
  EXPECT_EQ(frames[2]["frame"], 3);
}

TEST(Sequence, RendersFindsSkipsAndReports) {
  const Folder folder;
  for (const char* name : {"s.0001.exr", "s.0002.exr", "s.0005.exr"}) {
    write_picture_file(folder, name, {"R", "G", "B", "Z"});
  }
  expect_ok(defray(folder, "render s.%04d.exr -o a.%04d.exr -q" + lens));
  for (const char* name : {"a.0001.exr", "a.0002.exr", "a.0005.exr"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  const Result gap = defray(folder, "render s.%04d.exr -o g.%04d.exr" + lens);
  EXPECT_EQ(gap.code, 0);
  EXPECT_EQ(gap.err, "defray: note: s.%04d.exr: no frame 3-4\n");
  std::filesystem::remove(folder / "a.0002.exr");
  const Result skip =
      defray(folder, "render s.%04d.exr -o a.%04d.exr --skip-existing --frames 1,2,5" + lens);
  expect_ok(skip);
  EXPECT_NE(skip.out.find("a.0001.exr: exists, skipped"), std::string::npos) << skip.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "a.0002.exr"));
  const Result missing =
      defray(folder, "render 's.####.exr' -o 'b.####.exr' --frames 1-5x2" + lens);
  EXPECT_EQ(missing.code, 3);
  EXPECT_NE(missing.err.find("s.0003.exr: no such file"), std::string::npos) << missing.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "b.0005.exr"));
  const Result on =
      defray(folder, "render 's.####.exr' -o 'b.####.exr' --frames 1-5x2 --skip-bad-frames" + lens);
  EXPECT_EQ(on.code, 1);
  EXPECT_NE(on.err.find("1 of 3 frames failed"), std::string::npos) << on.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "b.0005.exr"));
}

/// While one frame is rendered the next is read and the last is written.
TEST(Sequence, FramesAreThoseOfCommandsOfTheirOwn) {
  const Folder folder;
  for (int i = 1; i <= 4; ++i) {
    write_picture_file(folder, fmt::format("s.000{}.exr", i), {"R", "G", "B", "Z"}, {20 + i, 16});
  }
  expect_ok(defray(folder, "render s.%04d.exr -o a.%04d.exr --coc-out c.%04d.exr -q" + lens));
  for (int i = 1; i <= 4; ++i) {
    expect_ok(defray(folder, fmt::format("render s.000{}.exr -o b.exr -q", i) + lens));
    EXPECT_EQ(file_hash(folder / fmt::format("a.000{}.exr", i)), file_hash(folder / "b.exr"));
    EXPECT_TRUE(std::filesystem::exists(folder / fmt::format("c.000{}.exr", i)));
  }
}

TEST(Sequence, WithoutOverlapAFrameCanBeMadeOfTheLast) {
  const Folder folder;
  write_picture_file(folder, "s.0001.exr", {"R", "G", "B", "Z"});
  for (int i = 2; i <= 4; ++i) {
    std::filesystem::create_symlink(fmt::format("a.000{}.exr", i - 1),
                                    folder / fmt::format("s.000{}.exr", i));
  }
  const std::string command = "render s.%04d.exr -o a.%04d.exr --frames 1-4 --json" + lens;
  const Result result = defray(folder, command + "--no-overlap");
  expect_ok(result);
  EXPECT_NE(file_hash(folder / "a.0004.exr"), file_hash(folder / "a.0003.exr"));
  const auto first = nlohmann::json::parse(result.out.substr(0, result.out.find('\n')));
  for (const char* step : {"read_s", "render_s", "write_s"}) EXPECT_GT(first[step], 1e-6) << step;
}

TEST(Sequence, AFrameThatIsMissingCanBeLeftOut) {
  const Folder folder;
  write_picture_file(folder, "s.0001.exr", {"R", "G", "B", "Z"});
  expect_refusal(defray(folder, "render s.####.exr -o a.####.exr --frames 1-2 -q" + lens), 3,
                 {"s.0002.exr: no such file: 1 of 2 frames have no picture; --skip-bad-frames "
                  "leaves them out\n"},
                 "two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.0001.exr"));
  expect_refusal(defray(folder, "render s.####.exr -o a.####.exr --frames 2" + lens), 3,
                 {"s.0002.exr: no such file\n"}, "one");
  std::ofstream(folder / "s.0003.exr") << "no picture";
  expect_refusal(defray(folder, "render s.####.exr -o a.####.exr --frames 1,3 -q" + lens), 3,
                 {"s.0003.exr: ", "; --skip-bad-frames leaves such frames out\n"}, "damaged");
  for (const char* name : {"s.0003.exr", "a.0001.exr"}) std::filesystem::remove(folder / name);
  write_picture_file(folder, "s.0002.exr", {"R", "G", "B"});
  write_picture_file(folder, "z.0002.exr", {"Z"});
  const std::string with_depth = "render s.####.exr -o a.####.exr --depth z.####.exr";
  expect_refusal(defray(folder, with_depth + lens), 3,
                 {"z.0001.exr: no such file: 1 of 2 frames have no depth; --skip-bad-frames"},
                 "depth");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.0002.exr"));
  EXPECT_EQ(defray(folder, with_depth + " --skip-bad-frames" + lens).code, 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.0002.exr"));
}

TEST(Sequence, AFrameThatCannotBeWrittenEndsTheRunAfterThoseBeforeIt) {
  const Folder folder;
  for (int i = 1; i <= 4; ++i) {
    write_picture_file(folder, fmt::format("s.000{}.exr", i), {"R", "G", "B", "Z"});
  }
  std::filesystem::create_directory(folder / "a.0003.exr");
  const Result result = defray(folder, "render s.%04d.exr -o a.%04d.exr --json" + lens);
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.err.find("a.0003.exr: is a folder"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
  EXPECT_LT(result.out.find("a.0001.exr"), result.out.find("a.0002.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a.0002.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.0004.exr"));
}

TEST(Sequence, ProgressBarOnATerminalOnly) {
  const Folder folder;
  for (const char* name : {"s.0001.exr", "s.0002.exr"}) {
    write_picture_file(folder, name, {"R", "G", "B", "Z"});
  }
  const std::string command = "render s.%04d.exr -o a.%04d.exr" + lens;
  EXPECT_EQ(defray(folder, command).err, "");
  const Result terminal =
      shell(folder, "script -qec \"" + program() + " " + command + "\" /dev/null");
  expect_ok(terminal);
  EXPECT_NE(terminal.out.find("1/2 frames"), std::string::npos) << terminal.out;
  EXPECT_NE(terminal.out.find("left"), std::string::npos) << terminal.out;
}

}  // namespace
}  // namespace defray::test::sequence_command_test
