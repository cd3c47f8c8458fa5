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

TEST(Sequence, NumbersHaveUpToNineDigits) {
  EXPECT_EQ(parse_frames("999999999,-999999999"), (std::vector<int>{999999999, -999999999}));
  for (const char* bad : {"1000000000", "-1000000000", "1-1000000000x100000", "99999999999999"}) {
    expect_error(ErrorKind::usage, {"not a frame range"}, [bad] { parse_frames(bad); });
  }
  // Padded to as many as 32.
  EXPECT_EQ(frame_path("%032d", 5), std::string(31, '0') + "5");
  EXPECT_EQ(frame_path(std::string(32, '#'), 5), std::string(31, '0') + "5");
  for (const std::string& wide : {std::string("%033d"), std::string(33, '@')}) {
    expect_error(ErrorKind::usage, {"too many digits", "32"}, [&] { frame_path(wide, 5); });
  }
}

TEST(Sequence, StepsGoFromTheFirstFrameToTheLast) {
  EXPECT_EQ(parse_frames("5-5"), std::vector<int>{5});
  EXPECT_EQ(parse_frames("5-6x5"), std::vector<int>{5});
  EXPECT_EQ(parse_frames("1-7x3"), (std::vector<int>{1, 4, 7}));
  EXPECT_EQ(parse_frames("7-1x-3"), (std::vector<int>{7, 4, 1}));
  EXPECT_EQ(parse_frames("1-7y3"), (std::vector<int>{2, 3, 5, 6}));
  EXPECT_EQ(parse_frames("7-1y3"), (std::vector<int>{6, 5, 3, 2}));
  EXPECT_EQ(parse_frames("1-7y-3"), (std::vector<int>{6, 5, 3, 2}));
  EXPECT_EQ(parse_frames("-1-1"), (std::vector<int>{-1, 0, 1}));
  EXPECT_EQ(parse_frames("4,2-5,3-6"), (std::vector<int>{4, 2, 3, 5, 6}));
  for (const char* bad : {"1-7x", "1-7y", "1-7z2", "1-7x2x2", "1 -7", "1-7x2 ", "x2"}) {
    expect_error(ErrorKind::usage, {"not a frame range"}, [bad] { parse_frames(bad); });
  }
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
  expect_error(ErrorKind::input, {"t.%d.exr: no file", "t.0002.exr has another number of digits"},
               [&] { find_frames(folder / "t.%d.exr"); });
  EXPECT_EQ(find_frames(folder / "s.###.exr"), (std::vector<int>{1}));
  for (const std::string wide : {"%0999d", "%099999999999999999999d"}) {
    expect_error(ErrorKind::usage, {"too many digits"}, [&] { frame_path(wide + ".exr", 1); });
  }
  const std::string hashes(1000000, '#');  // std::regex would run out of stack
  expect_error(ErrorKind::usage, {"too many digits"}, [&] { has_frame_pattern(hashes); });
  expect_error(ErrorKind::usage, {"2 frame patterns"}, [] { frame_path("s_%04d.####.exr", 1); });
}

TEST(Sequence, GapsAreWhatIsMissingBetweenFrames) {
  EXPECT_EQ(gaps_between({7}), "");
  EXPECT_EQ(gaps_between({-1, 0, 1, 2}), "");
  EXPECT_EQ(gaps_between({1, 3, 5}), "");  // on twos
  EXPECT_EQ(gaps_between({1, 2, 4, 10}), "3, 5-9");
  EXPECT_EQ(gaps_between({0, 1, 3, 5, 7, 9, 11}), "2, 4, 6, 8, 10");
  EXPECT_EQ(gaps_between({0, 1, 3, 5, 7, 9, 11, 13, 15}), "2, 4, 6, 8, 10, ...");
  EXPECT_EQ(gaps_between({-2147483647, 0, 2147483647}), "");
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
