// defray render over sequences: frames found, skipped, failed, reported.
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
