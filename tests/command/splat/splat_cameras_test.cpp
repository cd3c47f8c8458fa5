// defray splat: turns, cameras of each frame, lenses.
#include <cmath>
#include <fstream>
#include <sstream>

#include "splat_command.h"

namespace defray::test::splat_command_test {
namespace {

TEST_F(SplatCommand, ATurn) {
  const Result result = defray(folder_, figure + "--json --turntable 4 -o t.####.exr " + wide_lens);
  expect_ok(result);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 4);
  EXPECT_EQ(file_hash(folder_ / "t.0001.exr"), hash(wide_lens));
  EXPECT_NE(file_hash(folder_ / "t.0001.exr"), file_hash(folder_ / "t.0003.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.0005.exr"));
}

/// A turn's frames, those of cameras, and those in which the lens changes.
TEST_F(SplatCommand, FramesOfATurnOfCamerasAndOfALens) {
  const auto frame = [&](const std::string& options, int number) {
    const std::string command = figure + "-q -o f.####.exr " + options;
    expect_ok(defray(folder_, command));
    return file_hash(folder_ / fmt::format("f.{:04}.exr", number));
  };
  const std::uint64_t third = frame("--turntable 4 " + wide_lens, 3);
  expect_ok(shell(folder_, "rm f.*"));
  EXPECT_EQ(frame("--turntable 4 --frames 3 " + wide_lens, 3), third);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.0001.exr"));

  const std::string focus = "--frames 1,3 --focus 3:1,4:5 " + wide_lens;
  EXPECT_EQ(frame(focus, 3), hash(wide_lens + "--focus 3.5"));
  EXPECT_EQ(frame(focus, 1), hash(wide_lens + "--focus 3"));
  EXPECT_EQ(frame("--frames 2 --max-coc 1:1,3:3 " + wide_lens, 2), hash(wide_lens + "--max-coc 2"));

  for (const int number : {1, 2}) {
    std::ofstream(folder_ / fmt::format("c.{:04}.json", number))
        << R"({"focal_length_mm": 50, "aperture_diameter_m": 3, "focus_distance_m": )" << 2 + number
        << R"(, "from_m": [)" << number << R"(, 1, 4], "look_at_m": [0, 0, 0], "up": [0, 1, 0]})";
  }
  EXPECT_EQ(frame("--camera c.####.json", 2), hash(wide_lens + "--focus 4 --from 2,1,4 --look-at "
                                                               "0,0,0"));
  EXPECT_EQ(file_hash(folder_ / "f.0001.exr"),
            hash(wide_lens + "--focus 3 --from 1,1,4 --look-at 0,0,0"));
  // Where the camera stands counts beside a whole lens, too.
  EXPECT_EQ(hash("--camera c.0002.json --focus 3 --sensor-width 36 " + wide_lens),
            hash(wide_lens + "--focus 3 --from 2,1,4 --look-at 0,0,0"));
  refused(figure + "-o o.exr --camera c.####.json", 2, {"o.exr", "2 frames would go to one file"});
  refused(figure + "-o f.####.exr --camera c.####.json --frames 1-3", 3, {"c.0003.json"});
  refused(figure + "-o f.####.exr --camera c.####.json --turntable 3", 2,
          {"--turntable goes round with one camera, c.####.json are many"});
  refused(figure + "-o f.####.exr --turntable 3 --frames 2-4 " + wide_lens, 2,
          {"--frames has 4: the turn's frames are 1 to 3"});
  refused(figure + "-o o.exr --focus 3:1,4:5 " + wide_lens, 2,
          {"--focus changes over frames: say which, with --frames"});
}

TEST_F(SplatCommand, FramesThatExistAreSkippedAndFoldersMade) {
  const std::string turn = figure + "--turntable 3 -o new/t.####.exr " + wide_lens;
  refused(turn, 4, {"new", "--mkdir makes it"});
  expect_ok(defray(folder_, turn + " --mkdir -q"));
  const auto frame = [&](int i) { return folder_ / fmt::format("new/t.{:04}.exr", i); };
  const std::uint64_t second = file_hash(frame(2)), third = file_hash(frame(3));
  std::ofstream(frame(1)) << "old";
  std::filesystem::remove(frame(2));
  std::ofstream(frame(3)).flush();
  const Result again = defray(folder_, turn + " --skip-existing --json");
  expect_ok(again);
  std::istringstream lines(again.out);
  for (const std::string status : {"skipped", "ok", "ok"}) {
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(json::parse(line)["status"], status) << line;
  }
  EXPECT_EQ(std::filesystem::file_size(frame(1)), 3u);
  EXPECT_EQ(file_hash(frame(2)), second);
  EXPECT_EQ(file_hash(frame(3)), third);
  // Where all are there, the points are not even read.
  const Result none = defray(
      folder_, "splat none.ply -o new/t.####.exr --turntable 3 --skip-existing " + wide_lens);
  expect_ok(none);
  EXPECT_NE(none.out.find("new/t.0003.exr: exists, skipped"), std::string::npos) << none.out;
}

/// One is drawn while the last is written: those before stay, and none comes after.
TEST_F(SplatCommand, AFrameThatCannotBeWrittenEndsTheRun) {
  std::filesystem::create_directory(folder_ / "f.0002.exr");
  refused(figure + "-q --turntable 4 -o f.####.exr " + wide_lens, 4,
          {"f.0002.exr", "Is a directory"});
  EXPECT_EQ(file_hash(folder_ / "f.0001.exr"), hash(wide_lens));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.0003.exr"));
}

TEST_F(SplatCommand, AnEyeIsALens) {
  const std::string eye = "--focus 3 --eye ", same =
                                                  "--focus 3 --aperture-diameter 4.6 "
                                                  "--focal-length 17 --pixel-scale 28000";
  EXPECT_EQ(hash(eye), hash(same));
  const std::string display = "--focus 3 --eye=display ";
  EXPECT_NE(hash(display), hash(eye));
  EXPECT_NE(hash(display + "--display-distance 0.3"), hash(display));
  EXPECT_NE(hash(display + "--display-resolution 8000"), hash(display));
}

TEST_F(SplatCommand, ACameraFileHasLensAndPose) {
  std::ofstream(folder_ / "c.json")
      << R"({"focal_length_mm": 50, "focus_distance_m": 4, "aperture_diameter_m": 3,
             "from_m": [1, 1, 4], "look_at_m": [0, 0.2, 0], "up": [0, 1, 0.1]})";
  EXPECT_EQ(hash("--camera c.json"),
            hash(wide_lens + "--focus 4 --from 1,1,4 --look-at 0,0.2,0 --up 0,1,0.1"));
  EXPECT_NE(hash("--camera c.json --from 1,1,5"), hash("--camera c.json"));
  for (const auto& [text, words] :
       {std::pair{R"({"from_m": [1, 1]})", "'from_m' is no list of three numbers"},
        {R"({"from_m": [1, 1, 2]})", "has 'from_m' alone"},
        {R"({"look_at_m": [1, 1, 2]})", "has 'look_at_m' alone"},
        {R"({"up": [1, 1, 2]})", "has 'up' alone"}}) {
    std::ofstream(folder_ / "b.json") << text;
    refused(figure + "-o o.exr --camera b.json " + wide_lens, 3, {"b.json", words});
  }
}

}  // namespace
}  // namespace defray::test::splat_command_test
