// defray render: names, folders and number formats of files.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "command/program.h"

namespace defray::test::files_command_test {
namespace {

class Files : public testing::Test {
 protected:
  Files() { write_picture_file(folder_, "in.exr", {"R", "G", "B", "A", "Z"}); }
  Result render(const std::string& arguments) const {
    return defray(folder_, "render " + arguments + lens);
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(render(arguments), code, words, arguments);
  }
  std::string type(const std::string& name, int channel = 0) const {
    const auto input = OIIO::ImageInput::open(folder_ / name);
    return input->spec().channelformat(channel).c_str();
  }
  Folder folder_;
};

TEST_F(Files, BitsAreThoseAskedFor) {
  for (const auto& [options, file, expected] : {std::tuple{"-o a.png", "a.png", "uint8"},
                                                {"-o b.png --bits 16", "b.png", "uint16"},
                                                {"-o c.png --bits 8", "c.png", "uint8"},
                                                {"-o d.exr", "d.exr", "float"},
                                                {"-o e.exr --bits half", "e.exr", "half"},
                                                {"-o f.tif", "f.tif", "float"},
                                                {"-o g.tif --bits 16", "g.tif", "uint16"},
                                                {"-o h.tif --bits 8", "h.tif", "uint8"},
                                                {"-o i.tif --bits float", "i.tif", "float"}}) {
    expect_ok(render("in.exr " + std::string(options)));
    EXPECT_EQ(type(file), expected) << options;
  }
  EXPECT_EQ(type("e.exr", 4), "float") << "depth stays as it is";
  // 16 bits go in, 16 bits come out, PNG and TIFF.
  expect_ok(render("b.png --depth in.exr -o j.png"));
  EXPECT_EQ(type("j.png"), "uint16");
  expect_ok(render("g.tif --depth in.exr -o k.tif"));
  EXPECT_EQ(type("k.tif"), "uint16");
  expect_ok(render("g.tif --depth in.exr -o l.png"));
  EXPECT_EQ(type("l.png"), "uint16");
  expect_ok(render("b.png --depth in.exr -o o.tif"));
  EXPECT_EQ(type("o.tif"), "uint16");
  expect_ok(render("b.png --depth in.exr -o o.exr"));
  EXPECT_EQ(type("o.exr"), "float");
  expect_ok(render("b.png --depth in.exr -o m.jpg"));
  expect_ok(render("a.png --depth in.exr -o n.png"));
  EXPECT_EQ(type("n.png"), "uint8");
  expect_ok(render("a.png --depth in.exr -o p.tif"));
  EXPECT_EQ(type("p.tif"), "float") << "eight linear bits would show steps";
  expect_refused("in.exr -o o.exr --bits 16", 2,
                 {"o.exr: its format has no such --bits; allowed are half float"});
  expect_refused("in.exr -o o.jpg --bits 16", 2, {"allowed are 8"});
  expect_refused("in.exr -o o.png --bits half", 2, {"allowed are 8 16"});
  expect_refused("in.exr -o o.tif --bits half", 2, {"allowed are 8 16 float"});
  expect_refused("in.exr -o o.hdr --bits float", 2, {"its format is fixed"});
}

TEST_F(Files, SixteenBitsKeepTheirSteps) {
  cv::Mat image(32, 48, CV_16UC3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 48; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.ptr<std::uint16_t>(y)[3 * x + c] = static_cast<std::uint16_t>(y * 2000 + x * 31 + c);
      }
    }
  }
  cv::imwrite(folder_ / "deep.png", image);
  expect_ok(defray(folder_,
                   "render deep.png --depth in.exr -o same.png --focus 3 "
                   "--aperture-diameter 0 --focal-length 50"));
  const cv::Mat same = cv::imread(folder_ / "same.png", cv::IMREAD_UNCHANGED);
  ASSERT_EQ(same.type(), CV_16UC3);
  EXPECT_EQ(cv::norm(image, same, cv::NORM_INF), 0);
}

TEST_F(Files, APictureOfOneChannel) {
  write_picture_file(folder_, "grey.exr", {"Y", "Z"});
  expect_ok(render("grey.exr -o out.exr"));
  write_picture_file(folder_, "rgb.exr", {"R", "G", "B", "Z"});
  const ImageFile grey = ImageFile::read(folder_ / "grey.exr");
  ImageFile::from_planes({"R", "G", "B", "Z"},
                         {grey.plane(0, 0), grey.plane(0, 0), grey.plane(0, 0), grey.plane(0, 1)},
                         48, 32, Sample::single_float)
      .write(folder_ / "rgb.exr");
  expect_ok(render("rgb.exr -o rgb_out.exr"));
  EXPECT_EQ(ImageFile::read(folder_ / "out.exr").plane(0, 0),
            ImageFile::read(folder_ / "rgb_out.exr").plane(0, 0));
  for (const std::string format : {"png", "hdr", "tif", "jpg"}) {
    expect_ok(render("grey.exr -o out." + format));
    expect_ok(render("rgb.exr -o rgb_out." + format));
    expect_ok(defray(folder_, "compare out." + format + " rgb_out." + format + " --max-error 0"));
  }
  write_picture_file(folder_, "ya.exr", {"Y", "A", "Z"});
  expect_ok(render("ya.exr -o out.exr"));
  EXPECT_NE(file_hash(folder_ / "out.exr"), file_hash(folder_ / "ya.exr"));
}

TEST_F(Files, AGreyPictureIsNotItsOwnDepth) {
  write_picture_file(folder_, "grey.exr", {"Y"});
  write_picture_file(folder_, "ya.exr", {"Y", "A"});
  for (const std::string name : {"grey.exr", "ya.exr"}) {
    expect_refused(name + " -o none.exr", 3, {name + ": no depth", "with --depth, or"});
    const Result info = defray(folder_, "info " + name);
    expect_ok(info);
    EXPECT_NE(info.out.find("no depth: give it with --depth FILE"), std::string::npos) << info.out;
  }
  for (const std::string again : {"grey.exr", "./grey.exr"}) {
    expect_refused("grey.exr --depth " + again + " -o none.exr", 3, {"grey.exr: no depth"});
  }
  // In a file of its own, or where it is asked for, it may be.
  expect_ok(render("grey.exr --depth grey.exr --depth-channel Y -o out.exr"));
  shell(folder_, "cp grey.exr copy.exr");
  expect_ok(render("grey.exr --depth copy.exr -o out.exr"));
  expect_ok(render("in.exr --depth grey.exr -o out.exr"));
  expect_ok(render("ya.exr --depth grey.exr -o out.exr"));
}

TEST_F(Files, NamesThatAreNoPatterns) {
  expect_ok(render("in.exr -o hero@2x.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "hero@2x.png"));
  expect_refused("in.exr -o a.####.exr", 2, {"a frame pattern", "--no-pattern takes it as a name"});
  expect_ok(render("in.exr -o a.####.exr --no-pattern"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.####.exr"));
  shell(folder_, "cp in.exr s@2x.0001.exr; cp in.exr s@2x.0002.exr");
  expect_ok(render("s@2x.####.exr -o o@2x.####.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "o@2x.0002.exr"));
}

TEST_F(Files, SkipExistingLooksAtEveryOutput) {
  shell(folder_, "cp in.exr s.0001.exr; cp in.exr s.0002.exr");
  const std::string command =
      "s.####.exr -o o.####.exr --coc-out coc.####.exr --confidence-out confidence.####.exr "
      "--tiles-out tiles.####.exr --error-out error.####.exr --skip-existing";
  expect_ok(render(command));
  for (const std::string output : {"o", "coc", "confidence", "tiles", "error"}) {
    std::filesystem::remove(folder_ / (output + ".0002.exr"));
    const Result again = render(command);
    expect_ok(again);
    EXPECT_NE(again.out.find("o.0001.exr: exists, skipped"), std::string::npos) << output;
    EXPECT_EQ(again.out.find("o.0002.exr: exists, skipped"), std::string::npos) << output;
    EXPECT_TRUE(std::filesystem::exists(folder_ / (output + ".0002.exr"))) << output;
  }
}

TEST_F(Files, AnEmptyFileIsNoOutput) {
  for (const std::string option : {"", " --coc-out coc.exr"}) {
    std::ofstream(folder_ / "o.exr") << (option.empty() ? "" : "whole");
    std::ofstream(folder_ / "coc.exr") << "";
    const Result first = render("in.exr -o o.exr --skip-existing" + option);
    expect_ok(first);
    EXPECT_EQ(first.out.find("skipped"), std::string::npos) << option << first.out;
    EXPECT_EQ(ImageFile::read(folder_ / "o.exr").parts()[0].data.width, 48);
    const Result again = render("in.exr -o o.exr --skip-existing" + option);
    EXPECT_NE(again.out.find("o.exr: exists, skipped"), std::string::npos) << again.out;
  }
  std::filesystem::create_directory(folder_ / "folder.exr");
  expect_refused("in.exr -o folder.exr --skip-existing", 4, {"folder.exr: is a folder"});
}

TEST_F(Files, FoldersAreMadeWhereAsked) {
  expect_refused("in.exr -o a/b/o.exr", 4, {"cannot write in folder a/b", "--mkdir makes it"});
  // Of commands without the option nobody says so.
  const Result other = defray(folder_, "sheet in.exr -o a/b/o.png");
  EXPECT_EQ(other.code, 4);
  EXPECT_EQ(other.err.find("--mkdir"), std::string::npos) << other.err;
  expect_ok(render("in.exr -o a/b/o.exr --coc-out c/d.exr --mkdir"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a/b/o.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "c/d.exr"));
  // Not before there is something to write.
  expect_refused("misspelt.exr -o e/f/o.exr --mkdir", 3, {"misspelt.exr: no such file"});
  expect_refused("in.exr -o e/f/o.exr --mkdir --device nothing", 5, {"nothing"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "e"));
  std::ofstream(folder_ / "file") << "x";
  for (const std::string below : {"file", "file/a/b"}) {
    expect_refused("in.exr -o " + below + "/o.exr --mkdir", 4,
                   {below + ": cannot create this folder: Not a directory"});
  }
  std::filesystem::create_directory(folder_ / "folder.exr");
  expect_refused("in.exr -o folder.exr --mkdir", 4, {"folder.exr: is a folder, not a file name"});
  expect_refused("in.exr -o /proc/none/o.exr --mkdir", 4, {"cannot write in folder /proc"});
}

TEST_F(Files, WhatKilledRunsLeftGoes) {
  SKIP_UNLESS_FULL();
  const Result running = shell(folder_, "mkdir out; " + program() +
                                            " render in.exr -o out/o.exr "
                                            "--rdb 60" +
                                            lens +
                                            ">/dev/null & job=$!; n=0; "
                                            "while [ $n -lt 500 ]; do ls -A out | grep -q defray "
                                            "&& break; sleep 0.01; n=$((n+1)); done; "
                                            "kill -9 $job; wait $job; ls -A out");
  // By its name: on this machine, of a process that is no more.
  const std::string name = shell(folder_, "ls -A out | grep defray").out;
  if (!name.empty()) {
    expect_ok(render("in.exr -o out/p.exr"));
    EXPECT_EQ(shell(folder_, "ls -A out | grep -c defray").out, "0\n") << running.out;
  }
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string mark =
      fmt::format("{:08x}", std::hash<std::string>()(host.data()) & 0xffffffff);
  const auto file = [&](const std::string& left) {
    std::ofstream(folder_ / ("out/" + left)) << "x";
  };
  file(".a.defray-" + mark + "-999999999.exr");
  file(".b.defray+" + mark + "-999999999.exr");
  file(".c.defray-" + mark + "-1.exr");         // runs
  file(".d.defray-00000000-999999999.exr");     // another machine's
  file("e.defray-" + mark + "-999999999.exr");  // not hidden: a user's
  file(".f.exr");
  expect_ok(render("in.exr -o out/p.exr"));
  const std::string left = shell(folder_, "ls -A out").out;
  for (const char* gone : {".a.", ".b."}) EXPECT_EQ(left.find(gone), std::string::npos) << left;
  for (const char* kept : {".c.", ".d.", "e.defray", ".f.exr", "p.exr"}) {
    EXPECT_NE(left.find(kept), std::string::npos) << kept << " in " << left;
  }
}

TEST_F(Files, AFullDiskSaysSoInEveryFormat) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to mount a small file system";
  write_picture_file(folder_, "large.exr", {"R", "G", "B", "Z"}, {320, 200});
  std::filesystem::create_directory(folder_ / "disk");
  if (shell(folder_, "mount -t tmpfs -o size=16k tmpfs disk").code != 0) {
    GTEST_SKIP() << "cannot mount here";
  }
  std::vector<Result> results;
  const std::vector<std::string> formats{"exr", "tif", "hdr", "png", "jpg"};
  for (const std::string& format : formats) {
    results.push_back(render("large.exr --method linear -o disk/out." + format));
    results.push_back(defray(folder_, "sheet large.exr -o disk/s.png"));
  }
  const std::string left = shell(folder_, "ls -A disk").out;
  shell(folder_, "umount disk");
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].code, 4) << formats[i / 2] << results[i].err;
    EXPECT_NE(results[i].err.find("No space left on device"), std::string::npos)
        << formats[i / 2] << ": " << results[i].err;
  }
  EXPECT_EQ(left, "");
}

}  // namespace
}  // namespace defray::test::files_command_test
