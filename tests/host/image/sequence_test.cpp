// Frame ranges and the names of frames.
#include "image/sequence.h"

#include <fstream>

#include "support.h"

namespace defray::test::sequence_test {
namespace {

TEST(Sequence, Ranges) {
  EXPECT_EQ(parse_frames("1-4"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("1-10x3"), (std::vector<int>{1, 4, 7, 10}));
  EXPECT_EQ(parse_frames("7,3,9-10"), (std::vector<int>{7, 3, 9, 10}));
  EXPECT_EQ(parse_frames("-3--1"), (std::vector<int>{-3, -2, -1}));
  EXPECT_EQ(parse_frames("9-1x4"), (std::vector<int>{9, 5, 1}));
  EXPECT_EQ(parse_frames("1-10x-4"), (std::vector<int>{10, 6, 2}));
  EXPECT_EQ(parse_frames("1-6y2"), (std::vector<int>{2, 4, 6}));
  EXPECT_EQ(parse_frames("1-999999999x500000000"), (std::vector<int>{1, 500000001}));
  EXPECT_EQ(parse_frames("1,1,3-1"), (std::vector<int>{1, 3, 2}));
  for (const char* bad : {"", "a", "1-", "-", "1..3", "1-3x0", "1,,2", "1-3;4", "1e3"}) {
    expect_error(ErrorKind::usage, {"frames"}, [bad] { parse_frames(bad); });
  }
  for (const char* many : {"1-999999999", "1-999999999y1", "1-600000,600001-1200000"}) {
    expect_error(ErrorKind::usage, {"at most"}, [many] { parse_frames(many); });
  }
  // 1, 3 ... 2000001.
  expect_error(ErrorKind::usage, {"goes over 1000001 frames", "at most 1000000"},
               [] { parse_frames("1-2000002x2"); });
  EXPECT_EQ(parse_frames("1-2000000x2").size(), 1000000u);
  expect_error(ErrorKind::usage, {"not a frame range"}, [] { parse_frames("1-2000000000"); });
  expect_error(ErrorKind::usage, {"no frame"}, [] { parse_frames("1-1y2"); });
}

TEST(Sequence, Patterns) {
  EXPECT_EQ(frame_path("shot.####.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.##.exr", 7), "shot.07.exr");
  EXPECT_EQ(frame_path("shot.#.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.%04d.exr", 7), "shot.0007.exr");
  EXPECT_EQ(frame_path("shot.@@@.exr", 7), "shot.007.exr");
  EXPECT_EQ(frame_path("shot.####.exr", 12345), "shot.12345.exr");
  EXPECT_EQ(frame_path("shot.exr", 7), "shot.exr");
  EXPECT_EQ(frame_path("a%n.%d.exr", 7), "a%n.7.exr");
  EXPECT_EQ(frame_path("shot.%3d.exr", 7), "shot.  7.exr");
  EXPECT_EQ(frame_path("shot.####.exr", -7), "shot.-007.exr");
  EXPECT_TRUE(has_frame_pattern("a.####.exr"));
  EXPECT_FALSE(has_frame_pattern("a.exr"));
  const Folder folder;
  for (const char* name : {"s.0003.exr", "s.0001.exr", "s.001.exr", "t.0002.exr"}) {
    std::ofstream(folder / name) << "x";
  }
  EXPECT_EQ(find_frames(folder / "s.####.exr"), (std::vector<int>{1, 3}));
  expect_error(ErrorKind::input, {"no file matches"}, [&] { find_frames(folder / "u.####.exr"); });
  EXPECT_EQ(find_frames(folder / "s.###.exr"), (std::vector<int>{1}));
  for (const std::string wide : {"%0999d", "%099999999999999999999d"}) {
    expect_error(ErrorKind::usage, {"too many digits"}, [&] { frame_path(wide + ".exr", 1); });
  }
  const std::string hashes(1000000, '#');  // std::regex would run out of stack
  expect_error(ErrorKind::usage, {"too many digits"}, [&] { has_frame_pattern(hashes); });
  expect_error(ErrorKind::usage, {"2 frame patterns"}, [] { frame_path("s_%04d.####.exr", 1); });
}

TEST(Sequence, FoldersAndLiteralNamesAreNoPatterns) {
  const Folder folder;
  for (const char* name : {"me@home", "job_%d#2"}) {
    std::filesystem::create_directory(folder / name);
    const std::string inside = folder / name + "/";
    std::ofstream(inside + "s.0004.exr") << "x";
    std::ofstream(inside + "a@2x.exr") << "x";
    EXPECT_FALSE(has_frame_pattern(inside + "s.0004.exr"));
    EXPECT_FALSE(has_frame_pattern(inside + "a@2x.exr")) << "this very file exists";
    EXPECT_EQ(find_frames(inside + "s.####.exr"), (std::vector<int>{4}));
    EXPECT_EQ(frame_path(inside + "s.####.exr", 7), inside + "s.0007.exr");
  }
}

}  // namespace
}  // namespace defray::test::sequence_test
