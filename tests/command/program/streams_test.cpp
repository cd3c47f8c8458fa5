// Standard streams: closed, without a reader, full, and with pictures in them.
#include <unistd.h>

#include <fstream>

#include "command/program.h"

namespace defray::test::streams_test {
namespace {

struct Streams : testing::Test {
  void SetUp() override { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }
  Result run(const std::string& arguments, const std::string& redirections,
             const std::string& before = "") const {
    return shell(folder, before + program() + " " + arguments + " " + redirections);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }
  Folder folder;
  const std::string render = "render in.exr -o out.exr" + lens;
};

TEST_F(Streams, ClosedOnesEndNothingAndGetNoFilesNumber) {
  SKIP_UNLESS_FULL();
  expect_ok(defray(folder, "render in.exr -o usual.exr" + lens));
  for (const std::string closed : {">&-", "2>&-", "<&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    std::filesystem::remove(folder / "out.exr");
    EXPECT_EQ(run(render, closed).code, 0) << closed;
    EXPECT_EQ(file_hash(folder / "out.exr"), file_hash(folder / "usual.exr")) << closed;
  }
  for (const std::string closed : {">&-", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(run("render none.exr -o o.exr" + lens, closed).code, 3) << closed;
    EXPECT_EQ(run("render --focsu 3", closed).code, 2) << closed;
    // What only prints has lost it all; a picture is there without its log.
    const int code = closed == "2>&-" ? 0 : 4;
    EXPECT_EQ(run("devices", closed).code, code) << closed;
    EXPECT_EQ(run("info in.exr", closed).code, code) << closed;
  }
  const std::string psf = "psf --depth 4 --focus 3 --fstop 2 --focal-length 50";
  for (const std::string prints : {"compare in.exr in.exr", psf.c_str(), "tune --show"}) {
    EXPECT_EQ(run(prints, ">&-").code, 4) << prints;
  }
  EXPECT_EQ(run(psf + " --csv psf.csv", ">&-").code, 0);
  // A bound is told by the exit code, a sheet is a file.
  EXPECT_EQ(run("compare in.exr in.exr --min-psnr 40", ">&-").code, 0);
  EXPECT_EQ(run("compare in.exr in.exr --min-ssim 1.0 --max-error 0", ">&-").code, 0);
  expect_ok(run("render in.exr -o blurred.exr --focus 3 --fstop 0.1 --focal-length 50", ""));
  EXPECT_EQ(run("compare in.exr blurred.exr --min-psnr 90", ">&-").code, 1);
  EXPECT_EQ(run("compare in.exr in.exr --sheet sheet.png", ">&-").code, 0);
  for (const std::string prints : {"--help", "render --help", "--version"}) {
    EXPECT_EQ(run(prints, ">/dev/full").code, 4) << prints;
    EXPECT_EQ(run(prints, ">&-").code, 4) << prints;
    EXPECT_EQ(run(prints, "").code, 0) << prints;
  }
  EXPECT_EQ(run("", ">&-").code, 2) << "its help is for who gave no command";
  EXPECT_EQ(run("info in.exr", ">&-").err, run("info in.exr", ">/dev/full").err);
}

TEST_F(Streams, APictureForAClosedOutputIsRefused) {
  const Result closed = run("render in.exr -o -" + lens, ">&-");
  EXPECT_EQ(closed.code, 4);
  EXPECT_EQ(closed.err,
            "defray: error: standard output: is closed: no picture can be written there\n");
}

TEST_F(Streams, OnlyThePictureOfARenderComesFromThere) {
  const std::string depth = "render in.exr --depth - -o o.exr" + lens;
  for (const std::string& reads : {std::string("info -"), std::string("compare in.exr -"), depth}) {
    const Result result = run(reads, "<in.exr");
    EXPECT_EQ(result.code, 3) << reads;
    EXPECT_NE(result.err.find("-: no such file; standard input can be the picture that is "
                              "rendered, nothing else"),
              std::string::npos)
        << result.err;
  }
}

TEST_F(Streams, MessagesCallTheStreamsByTheirNames) {
  const std::string to_null = " <in.exr >/dev/null";
  const Result text = run("render - -o -" + lens, to_null);
  EXPECT_EQ(text.err.substr(0, text.err.find('\n')), "- -> -");
  const Result data = run("render - -o - --json" + lens, to_null);
  EXPECT_NE(data.err.find(R"("input":"-","output":"-")"), std::string::npos) << data.err;
  EXPECT_EQ((text.err + data.err).find("defray-stream"), std::string::npos) << data.err;
  write_picture_file(folder, "flat.exr", {"R", "G", "B"});
  for (const std::string more : {"", " --json --skip-bad-frames"}) {
    const Result flat = run("render - -o o.exr" + lens + more, "<flat.exr");
    EXPECT_NE(flat.err.find("defray: error: standard input: no depth"), std::string::npos)
        << flat.err;
    EXPECT_EQ((flat.out + flat.err).find("defray-stream"), std::string::npos) << flat.out;
  }
}

TEST_F(Streams, AFullTemporaryFolderIsNamed) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to mount a small file system";
  std::filesystem::create_directory(folder / "disk");
  if (shell(folder, "mount -t tmpfs -o size=8k tmpfs disk").code != 0) {
    GTEST_SKIP() << "cannot mount here";
  }
  const Result full =
      run("render - -o o.exr" + lens, "<in.exr", "TMPDIR='" + (folder / "disk") + "' ");
  shell(folder, "umount disk");
  EXPECT_EQ(full.code, 4);
  EXPECT_NE(full.err.find("standard input: cannot copy its "), std::string::npos) << full.err;
  EXPECT_NE(full.err.find("No space left on device; TMPDIR names another"), std::string::npos)
      << full.err;
}

TEST_F(Streams, AReaderThatGoesAwayStopsNoFrame) {
  for (int i = 1; i <= 3; ++i) {
    std::filesystem::copy(folder / "in.exr", folder / fmt::format("s.000{}.exr", i));
  }
  const Result gone = shell(folder, "{ " + program() + " render s.####.exr -o o.####.exr" + lens +
                                        "; echo code $? >&2; } | true");
  EXPECT_EQ(gone.err, "code 0\n");
  EXPECT_TRUE(exists("o.0003.exr"));
  EXPECT_EQ(shell(folder, "{ " + program() + " render --help; echo code $? >&2; } | true").err,
            "code 0\n");
}

TEST_F(Streams, AFullDiskUnderTheLogIsAnErrorWhenTheFramesAreDone) {
  const Result full = run(render, ">/dev/full");
  EXPECT_EQ(full.code, 4);
  EXPECT_EQ(full.err, "defray: error: cannot write to standard output\n");
  EXPECT_TRUE(exists("out.exr"));
}

TEST_F(Streams, PicturesGoInAndOut) {
  expect_ok(defray(folder, "render in.exr -o usual.exr" + lens));
  const Result piped =
      shell(folder, "cat in.exr | " + program() + " render - -o -" + lens + " | cat >piped.exr");
  expect_ok(piped);
  EXPECT_EQ(file_hash(folder / "piped.exr"), file_hash(folder / "usual.exr"));
  EXPECT_NE(piped.err.find("CoC radius"), std::string::npos)
      << "the report goes beside: " << piped.err;
  expect_ok(defray(folder,
                   "render in.exr -o in.png --aperture-diameter 0 --focus 3 "
                   "--focal-length 50"));
  expect_ok(
      shell(folder, program() + " render - --depth in.exr -o - -q" + lens + " <in.png >piped.png"));
  expect_ok(defray(folder, "render in.png --depth in.exr -o usual.png" + lens));
  EXPECT_EQ(shell(folder, "cmp piped.png usual.png").code, 0);
  const auto refused = [&](const std::string& input, const std::string& words) {
    const Result result = shell(folder, input + " | " + program() + " render - -o o.exr" + lens);
    EXPECT_EQ(result.code, 3);
    EXPECT_NE(result.err.find("standard input: " + words), std::string::npos) << result.err;
  };
  refused("true", "is empty; a picture is EXR, PNG");
  refused("echo hello", "is no picture");
  const Result full = shell(folder, program() + " render in.exr -o - -q" + lens + " >/dev/full");
  EXPECT_EQ(full.code, 4);
  EXPECT_NE(full.err.find("standard output: cannot write"), std::string::npos) << full.err;
}

TEST_F(Streams, NoFolderIsLeft) {
  std::filesystem::create_directory(folder / "tmp");
  const std::string there = "export TMPDIR='" + (folder / "tmp") + "'; ";
  expect_ok(shell(folder, there + program() + " render - -o - -q" + lens + " <in.exr >o.exr"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
  // That of a process that was killed goes with the next.
  const auto make = [&](const std::string& name) {
    std::filesystem::create_directory(folder / ("tmp/" + name));
  };
  make("defray-stream-999999999-abcdef");
  make("defray-stream-1-abcdef");  // runs
  make("defray-stream-x");
  make("defray-streams-999999999-abcdef");
  expect_ok(shell(folder, there + program() + " render - -o - -q" + lens + " <in.exr >o.exr"));
  EXPECT_EQ(shell(folder, "ls tmp").out,
            "defray-stream-1-abcdef\ndefray-stream-x\ndefray-streams-999999999-abcdef\n");
}

}  // namespace
}  // namespace defray::test::streams_test
