// defray compare over sequences: false edges and changes.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "base/srgb.h"
#include "command/measure/compare_command.h"
#include "image/ldr.h"

namespace defray::test::compare_sequence_test {
namespace {

using nlohmann::json;

/// Sequences of two frames: a dot in b's first, another place in its second, none in a.
class CompareSequences : public CompareCommand {
 protected:
  CompareSequences() {
    write("a.0001.exr", -1);
    write("a.0002.exr", -1);
    write("b.0001.exr", 10);
    write("b.0002.exr", 30);
  }

  void write(const std::string& name, int dot_x) {
    Plane plane(48 * 32, 0.2f);
    if (dot_x >= 0) plane[static_cast<std::size_t>(9 * 48 + dot_x)] = 0.8f;
    ImageFile::from_planes({"R", "G", "B"}, {plane, plane, plane}, 48, 32, Sample::single_float)
        .write(folder_ / name);
  }

  std::vector<json> frames(const std::string& arguments) {
    const Result result = defray(folder_, "compare --json " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    std::vector<json> lines;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
  }
};

TEST_F(CompareSequences, FrameByFrame) {
  const std::vector<json> lines = frames("b.####.exr a.####.exr --false-edges");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["frame"], 1);
  EXPECT_EQ(lines[1]["frame"], 2);
  EXPECT_EQ(lines[0]["worst_x"], 10);
  EXPECT_EQ(lines[1]["worst_x"], 30);
  EXPECT_FALSE(lines[0].contains("false_changes")) << "nothing comes before";
  const double dot = 255 * (shown_value(0.8f) - shown_value(0.2f));
  EXPECT_NEAR(lines[1]["false_edges"]["worst"], dot / 2, 1e-3);
  EXPECT_NEAR(lines[1]["false_changes"]["worst"], dot, 1e-3);
  EXPECT_NEAR(lines[1]["false_changes"]["rms"], dot * std::sqrt(2.0 / (48 * 32)), 1e-3);
  EXPECT_EQ(frames("b.####.exr a.####.exr --frames 2").size(), 1U);
  EXPECT_EQ(frames("b.####.exr a.####.exr --frames 2")[0]["frame"], 2);
  EXPECT_FALSE(frames("b.####.exr a.####.exr")[1].contains("false_edges"));
}

TEST_F(CompareSequences, PlacesAreTheDisplayWindows) {
  const std::vector<json> part = frames("b.####.exr a.####.exr --false-edges --crop 44x20+4+5");
  EXPECT_NEAR(part[1]["false_edges"]["worst_y"], 9, 1);
  EXPECT_NEAR(part[1]["false_edges"]["worst_x"], 30, 1);
  EXPECT_EQ(part[1]["false_changes"]["worst_y"], 9);
}

/// As those of tight renders whose blur grows from frame to frame.
TEST_F(CompareSequences, WindowsThatChangeFromFrameToFrame) {
  for (const std::string name : {"a", "b"}) {
    OIIO::ImageBuf whole(folder_ / (name + ".0002.exr"));
    const OIIO::ROI part(6, 40, 4, 28, 0, 1, 0, 3);
    OIIO::ImageBuf cut = OIIO::ImageBufAlgo::cut(whole, part);
    cut.specmod().x = 6, cut.specmod().y = 4;
    cut.specmod().full_width = 48, cut.specmod().full_height = 32;
    cut.write(folder_ / (name + ".0002.exr"));
  }
  const json line = frames("b.####.exr a.####.exr --false-edges")[1];
  EXPECT_EQ(line["worst_x"], 30);
  const double dot = 255 * (shown_value(0.8f) - shown_value(0.2f));
  EXPECT_NEAR(line["false_changes"]["worst"], dot, 1e-3);
  EXPECT_EQ(line["false_changes"]["worst_x"], 10) << "of the display window";
  EXPECT_EQ(line["false_changes"]["worst_y"], 9);
  ImageFile::from_planes({"Y"}, {Plane(48 * 32, 1.0f)}, 48, 32).write(folder_ / "mask.exr");
  const json masked = frames("b.####.exr a.####.exr --false-edges --mask mask.exr")[1];
  EXPECT_EQ(masked["false_changes"], line["false_changes"]);
  EXPECT_EQ(masked["rms"], line["rms"]);
}

TEST_F(CompareSequences, OnlyWhereAMaskIs) {
  // Both dots; the second frame's own; neither.
  for (const auto& [first, edges, changes] :
       {std::tuple{0, true, true}, std::tuple{20, true, true}, std::tuple{34, false, false}}) {
    Plane mask(48 * 32);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = static_cast<int>(i % 48) >= first;
    ImageFile::from_planes({"Y"}, {mask}, 48, 32).write(folder_ / "mask.exr");
    const json line = frames("b.####.exr a.####.exr --false-edges --mask mask.exr")[1];
    EXPECT_EQ(line["false_edges"]["worst"] > 1, edges) << first;
    EXPECT_EQ(line["false_changes"]["worst"] > 1, changes) << first;
    if (changes) {
      EXPECT_EQ(line["false_changes"]["worst_x"].get<int>(), first == 0 ? 10 : 30);
    }
  }
}

TEST_F(CompareSequences, TextEndsInASummary) {
  const Result result = defray(folder_, "compare b.####.exr a.####.exr --false-edges");
  for (const char* part :
       {"frame 1\nPSNR ", "frame 2\nPSNR ", "\nedges that B has not (255ths): RMS ",
        "\nchanges that B has not (255ths): RMS ",
        "99.9th percentile 107.56, worst 107.6 at pixel (10, 9)", "\n2 frames: PSNR ",
        " dB (frame 1)\n", "\n  edges that B has not: RMS ", "\n  changes that B has not: RMS "}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
}

TEST_F(CompareSequences, BoundsHoldForEveryFrame) {
  const std::string base = "b.####.exr a.####.exr --false-edges --crop 20x20+0+0";
  EXPECT_EQ(code(base + " --max-false-edges 60 --max-false-changes 120"), 0);
  const Result missed = defray(folder_, "compare " + base +
                                            " --max-false-edges 1 --max-false-changes 1"
                                            " --min-psnr 99");
  EXPECT_EQ(missed.code, 1);
  EXPECT_NE(missed.err.find("frame 1: --max-false-edges 1 is missed: "), std::string::npos);
  EXPECT_NE(missed.err.find("frame 2: --max-false-changes 1 is missed: "), std::string::npos);
  EXPECT_NE(missed.err.find("frame 1: --min-psnr 99 is missed: "), std::string::npos);
  EXPECT_EQ(missed.err.find("frame 2: --min-psnr"), std::string::npos) << "there it is equal";
}

TEST_F(CompareSequences, ASheetAFrame) {
  expect_ok(defray(folder_, "compare b.####.exr a.####.exr --sheet s.####.png"));
  EXPECT_GT(read_ldr(folder_ / "s.0001.png", Content::data).width, 0);
  EXPECT_GT(read_ldr(folder_ / "s.0002.png", Content::data).width, 0);
  refuse("b.####.exr a.####.exr --sheet s.png", 2, {"--sheet s.png", "frame pattern"});
}

TEST_F(CompareSequences, Mistakes) {
  refuse("b.####.exr a.0001.exr", 2, {"b.####.exr is a sequence, a.0001.exr one picture"});
  refuse("b.0001.exr a.####.exr", 2, {"a.####.exr is a sequence, b.0001.exr one picture"});
  refuse("b.0001.exr a.0001.exr --frames 1-2", 2, {"--frames without a sequence"});
  refuse("b.####.exr a.####.exr --frames 7", 3, {"b.0007.exr", "no such file"});
  refuse("none.####.exr a.####.exr", 3, {"none.####.exr", "no file matches"});
  const std::string edges = "b.0001.exr a.0001.exr --false-edges ";
  refuse(edges + "--max-false-edges nan", 2, {"--max-false-edges is not a number"});
  refuse(edges + "--max-false-edges -1", 2, {"--max-false-edges is -1"});
  refuse("b.####.exr a.####.exr --false-edges --max-false-changes -1", 2,
         {"--max-false-changes is -1"});
  refuse("b.####.exr a.####.exr --false-edges --max-false-changes nan", 2,
         {"--max-false-changes is not a number"});
  refuse(edges + "--max-false-changes 1", 2, {"--max-false-changes without a sequence"});
  refuse("b.0001.exr a.0001.exr --max-false-edges 1", 2, {"--max-false-edges requires"});
  refuse("b.####.exr a.####.exr --max-false-changes 1", 2, {"--max-false-changes requires"});
  write("c.0001.exr", -1);
  ImageFile::from_planes({"R", "G", "B"}, {Plane(9), Plane(9), Plane(9)}, 3, 3)
      .write(folder_ / "c.0002.exr");
  const Result resized = defray(folder_, "compare c.####.exr c.####.exr --false-edges");
  EXPECT_EQ(resized.code, 3);
  EXPECT_NE(resized.err.find("c.0001.exr has display window 48x32+0+0, c.0002.exr has 3x3+0+0"),
            std::string::npos)
      << resized.err;
}

}  // namespace
}  // namespace defray::test::compare_sequence_test
