// defray trade as a user runs it.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "image/ldr.h"

namespace defray::test::trade_command_test {
namespace {

using nlohmann::json;

class TradeCommand : public testing::Test {
 protected:
  Folder folder;
  const std::string lens = " --camera camera.json --focus-setting bg ";

  void SetUp() override {
    expect_ok(defray(folder, "scene fence -o . --width 96 --height 64 --truth-samples 4"));
  }

  static json named(const json& trade, const std::string& picture) {
    for (const json& point : trade["points"]) {
      if (point["picture"] == picture) return point;
    }
    ADD_FAILURE() << "no " << picture << " in " << trade;
    return {};
  }

  void expect_refused(const std::string& options, int code, const std::vector<std::string>& words) {
    expect_refusal(defray(folder, "trade " + options), code, words, options);
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
  }
};

TEST_F(TradeCommand, AMethodThatCannotIsLeftOut) {
  const std::string close =
      "trade pinhole.exr -o t --runs 1 --focus 0.02 --focal-length 10 --fstop 0.001 ";
  const Result result = defray(folder, close + "--truth truth_bg.exr --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("defray: note: linear is left out: CoC radii"), std::string::npos)
      << result.err;
  const json trade = json::parse(result.out);
  EXPECT_GT(named(trade, "gather")["true_db"], 0.0);
  for (const json& point : trade["points"]) EXPECT_NE(point["picture"], "linear");
}

/// Terminated when there is a picture, it leaves what was there.
TEST_F(TradeCommand, InterruptedItChangesNothing) {
  std::filesystem::create_directories(folder / "tmp");
  std::filesystem::create_directories(folder / "t");
  std::ofstream(folder / "t/preview.png") << "old";
  shell(folder, "TMPDIR=\"$PWD/tmp\" " + program() + " trade pinhole.exr -o t --runs 1000" + lens +
                    "& job=$!; for i in $(seq 200); do sleep 0.1; "
                    "ls tmp/defray-trade-*/preview.png >/dev/null 2>&1 && break; done; "
                    "kill $job; wait $job");
  EXPECT_EQ(std::filesystem::file_size(folder / "t/preview.png"), 3u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "t"), {}), 1);
}

TEST_F(TradeCommand, WithoutATruthErrorsAreExpected) {
  const Result result = defray(folder, "trade pinhole.exr -o t --json" + lens);  // 3 runs
  ASSERT_EQ(result.code, 0) << result.err;
  const json trade = json::parse(result.out);
  EXPECT_GT(named(trade, "normal")["spread"], 0.0);
  const std::map<std::string, std::string> options{{"preview", "preview"},
                                                   {"draft", "draft"},
                                                   {"draft-13", "draft --rdb 13"},
                                                   {"normal", "normal"},
                                                   {"normal-18", "normal --rdb 18"},
                                                   {"normal-25", "normal --rdb 25"},
                                                   {"high", "high"}};
  ASSERT_EQ(trade["points"].size(), options.size());
  for (const auto& [name, quality] : options) {
    const json point = named(trade, name);
    EXPECT_LT(point["low_db"], point["expected_db"]);
    EXPECT_GT(point["render_s"], 0.0);
    EXPECT_FALSE(point.contains("true_db"));
    const Result by_hand =
        defray(folder, "render pinhole.exr -o t/hand.png" + lens + "--json --quality " + quality);
    EXPECT_EQ(json::parse(by_hand.out)["expected"]["psnr_srgb_db"], point["expected_db"]);
    EXPECT_EQ(file_hash(folder / "t/hand.png"), file_hash(folder / ("t/" + name + ".png")));
    EXPECT_EQ(point["command"],
              "defray render pinhole.exr --camera camera.json --focus-setting bg "
              "-o t/" +
                  name + ".exr --quality " + quality);
  }
  for (const char* file : {"index.html", "trade.png", "trade.csv"}) {
    EXPECT_GT(std::filesystem::file_size(folder / ("t/" + std::string(file))), 100u) << file;
  }
  std::ifstream csv(folder / "t/trade.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "picture,recommended,seconds,spread,expected_db,low_db,high_db,true_db,command");
  for (const json& point : trade["points"]) {
    std::getline(csv, line);
    EXPECT_EQ(line,
              fmt::format("{},{},{},{},{},{},{},,{}", point["picture"].get<std::string>(),
                          point["picture"] == trade["recommended"] ? "yes" : "no",
                          point["render_s"].get<double>(), point["spread"].get<double>(),
                          point["expected_db"].get<double>(), point["low_db"].get<double>(),
                          point["high_db"].get<double>(), point["command"].get<std::string>()));
  }
}

/// The dial among what it chooses from: its picture, and the time of its search, too.
TEST_F(TradeCommand, ATargetIsAPointOfItsOwn) {
  const std::string command = "trade pinhole.exr -o t --runs 1 --json --target-db 26" + lens;
  const json trade = json::parse(defray(folder, command).out);
  const json point = named(trade, "target");
  EXPECT_GE(point["expected_db"], 26);
  EXPECT_EQ(point["spread"], 0.0);  // of one run
  std::string by_hand = point["command"];
  EXPECT_EQ(by_hand,
            "defray render pinhole.exr --camera camera.json --focus-setting bg -o t/target.exr "
            "--target-db 26");
  by_hand.replace(by_hand.find("t/target.exr"), 12, "t/hand.png");
  expect_ok(defray(folder, by_hand.substr(7)));
  EXPECT_EQ(file_hash(folder / "t/hand.png"), file_hash(folder / "t/target.png"));
}

TEST_F(TradeCommand, ACutOutsLensSpansItsFrame) {
  const auto db = [&](const std::string& options) {
    const Result result = defray(folder, "trade pinhole.exr -o t --runs 1 --json" + lens + options);
    EXPECT_EQ(result.code, 0) << result.err;
    const json point = json::parse(result.out)["points"][0];
    EXPECT_NE(point["command"].get<std::string>().find(options), std::string::npos) << point;
    return point["expected_db"].get<double>();
  };
  EXPECT_NE(db(""), db("--full-size 192x128+10+20"));
}

TEST_F(TradeCommand, NotesOnTheInputAreSaid) {
  const Result result =
      defray(folder, "trade pinhole.exr -o t --runs 1 --focus 90 --fstop 2 --focal-length 50");
  expect_ok(result);
  EXPECT_NE(result.err.find("defray: note: focus 90 lies outside all depths"), std::string::npos)
      << result.err;
  EXPECT_EQ(
      defray(folder, "trade pinhole.exr -o t --runs 1 -q --focus 90 --fstop 2 --focal-length 50")
          .err,
      "");
}

TEST_F(TradeCommand, ATruthTellsOfAllMethods) {
  const std::string truth = " --truth truth_bg.exr";
  const Result result = defray(folder, "trade pinhole.exr -o t --runs 1" + truth + lens);
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* word : {"preview", "high", "literal", "gather", "linear", "true dB",
                           "recommended, the fastest within 0.5 dB of the best", "t/index.html"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
  const json trade =
      json::parse(defray(folder, "trade pinhole.exr -o t --runs 1 --json" + truth + lens).out);
  ASSERT_EQ(trade["points"].size(), 10u);
  for (const json& point : trade["points"]) {
    const std::string name = point["picture"];
    const std::string command = point["command"];
    expect_ok(defray(folder, command.substr(std::string("defray ").size())));
    const json compared =
        json::parse(defray(folder, "compare t/" + name + ".exr truth_bg.exr --json").out);
    EXPECT_NEAR(compared["psnr_srgb_db"], point["true_db"], 1e-3) << name;
  }
  // The stages' bokeh is not the others'.
  const json bladed = json::parse(
      defray(folder, "trade pinhole.exr -o t --runs 1 --json --blades 5" + truth + lens).out);
  EXPECT_EQ(bladed["points"].size(), 7u);
  EXPECT_NE(named(bladed, "normal")["true_db"], named(trade, "normal")["true_db"]);
  EXPECT_EQ(defray(folder, "trade pinhole.exr -o t --runs 1 -q" + lens).out, "");
}

TEST_F(TradeCommand, WrongUseIsSaid) {
  expect_refused("pinhole.exr" + lens, 2, {"output"});
  expect_refused("lost.exr -o none" + lens, 3, {"lost.exr"});
  expect_refused("pinhole.exr -o none --truth lost.exr" + lens, 3, {"lost.exr"});
  expect_refused("pinhole.exr -o none --target-db 0" + lens, 2, {"--target-db is 0"});
  for (const std::string runs : {"0", "1001"}) {
    expect_refused("pinhole.exr -o none --runs " + runs + lens, 2,
                   {"--runs is " + runs + ": it must be 1 to 1000"});
  }
  expect_refused("'p.####.exr' -o none" + lens, 2, {"trade takes one picture"});
  expect_refused("pinhole.exr -o none --focus 3", 2, {"focal"});
  expect_refused("pinhole.exr -o none --quality draft" + lens, 2, {"--quality"});
  expect_ok(defray(folder, "scene fence -o small --width 48 --height 32 --truth-samples 1"));
  expect_refusal(
      defray(folder, "trade pinhole.exr -o t --runs 1 --truth small/truth_bg.exr" + lens), 3,
      {"small/truth_bg.exr", "48x32", "pinhole.exr has 96x64"}, "another size");
  EXPECT_FALSE(std::filesystem::exists(folder / "t"));
  expect_refused("pinhole.exr -o none --channels Z" + lens, 2, {"--channels"});
  expect_refused("pinhole.exr -o none --focus-frame 2" + lens, 2, {"--focus-frame"});
}

TEST_F(TradeCommand, WhatIsReadIsNotWrittenOver) {
  std::filesystem::create_directory(folder / "t");
  for (const std::string name : {"t/trade.png", "t/linear.png", "t/index.html", "t/draft.exr"}) {
    expect_ok(shell(folder, "cp truth_bg.exr " + name));
    expect_refusal(defray(folder, "trade pinhole.exr -o t --runs 1 --truth " + name + lens), 2,
                   {name + ": is read and would be written"}, name);
  }
  expect_ok(shell(folder, "cp camera.json t/trade.csv"));
  expect_refusal(
      defray(folder, "trade pinhole.exr -o t --runs 1 --camera t/trade.csv --focus-setting bg"), 2,
      {"t/trade.csv: is read and would be written"}, "camera");
}

TEST_F(TradeCommand, TruthsThatAreEqualOrNoNumbers) {
  const std::string sharp = " --focus 3 --aperture-diameter 0 --focal-length 50 --truth ";
  const Result equal = defray(folder, "trade pinhole.exr -o t --runs 1" + sharp + "pinhole.exr");
  EXPECT_EQ(equal.code, 0) << equal.err;
  EXPECT_NE(equal.out.find("equal"), std::string::npos) << equal.out;
  Plane plane(96 * 64, 0.5f);
  plane[100] = NAN;
  ImageFile::from_planes({"R", "G", "B"}, {plane, plane, plane}, 96, 64).write(folder / "nan.exr");
  expect_refused("pinhole.exr -o none --truth nan.exr" + lens, 3,
                 {"nan.exr: has nan at pixel (4, 1)"});
}

TEST_F(TradeCommand, ATruthOfAPartIsComparedThere) {
  OIIO::ImageBuf file(folder / "truth_bg.exr");
  file.read(0, 0, true, OIIO::TypeDesc::FLOAT);
  const OIIO::ROI part(30, 60, 20, 40, 0, 1, 0, file.nchannels());
  OIIO::ImageBuf cut = OIIO::ImageBufAlgo::cut(file, part);
  OIIO::ImageSpec& spec = cut.specmod();
  spec.x = 30, spec.y = 20, spec.full_x = spec.full_y = 0;
  spec.full_width = 96, spec.full_height = 64;
  cut.write(folder / "part.exr");
  const json trade = json::parse(
      defray(folder, "trade pinhole.exr -o t --runs 1 --json --truth part.exr" + lens).out);
  expect_ok(defray(folder, "render pinhole.exr -o out.exr --quality draft" + lens));
  const json there =
      json::parse(defray(folder, "compare out.exr truth_bg.exr --crop 30x20+30+20 --json").out);
  EXPECT_NEAR(named(trade, "draft")["true_db"], there["psnr_srgb_db"], 0.01);
}

TEST_F(TradeCommand, WhatIsNoTruthOrNoFileIsRefused) {
  ImageFile::from_planes({"Y"}, {Plane(96 * 64, 0.5f)}, 96, 64).write(folder / "grey.exr");
  expect_refused("pinhole.exr -o none --truth grey.exr" + lens, 3,
                 {"grey.exr: is grey, pinhole.exr has R G B"});
  for (const std::string dash :
       {"- -o none", "pinhole.exr -o -", "pinhole.exr -o none --truth -"}) {
    expect_refused(dash + lens, 2, {"trade reads files several times", "'-'"});
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "-"));
}

TEST_F(TradeCommand, CommandsAreForAShell) {
  expect_ok(shell(folder, "mkdir \"a 'b\"; cp pinhole.exr \"a 'b/in \\$x.exr\""));
  const json trade = json::parse(
      shell(folder,
            program() +
                " trade \"a 'b/in \\$x.exr\" -o 'o o' --runs 1 --json --eye=display --focus 3 "
                "--fstop 1.4 --focal-length 50")
          .out);
  for (const json& point : trade["points"]) {
    const std::string command = point["command"];
    EXPECT_NE(command.find("--eye=display"), std::string::npos) << command;
    const Result result = shell(folder, program() + command.substr(6) + " --json");
    ASSERT_EQ(result.code, 0) << command << result.err;
    EXPECT_EQ(json::parse(result.out)["expected"]["psnr_srgb_db"], point["expected_db"]);
  }
}

TEST_F(TradeCommand, ATruthsLayerIsTheInputs) {
  const ImageFile in = ImageFile::read(folder / "pinhole.exr");
  const ImageFile truth = ImageFile::read(folder / "truth_bg.exr");
  std::vector<Plane> planes;
  for (int c = 0; c < 3; ++c) planes.push_back(truth.plane(0, c));
  for (int c = 0; c < 3; ++c) planes.push_back(Plane(96 * 64, 0.5f));
  ImageFile::from_planes({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}, planes, 96, 64,
                         Sample::single_float)
      .write(folder / "layers.exr");
  for (std::size_t c = 0; c < 3; ++c) planes[c] = in.plane(0, static_cast<int>(c));
  planes.push_back(in.plane(0, 3));
  ImageFile::from_planes({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B", "Z"}, planes, 96, 64,
                         Sample::single_float)
      .write(folder / "in.exr");
  const json layered = json::parse(
      defray(folder, "trade in.exr -o t --runs 1 --json --layer a --truth layers.exr" + lens).out);
  const json plain = json::parse(
      defray(folder, "trade pinhole.exr -o t --runs 1 --json --truth truth_bg.exr" + lens).out);
  EXPECT_NEAR(named(layered, "normal")["true_db"], named(plain, "normal")["true_db"], 0.01);
  expect_refused("in.exr -o none --layer b --truth lost.exr" + lens, 3, {"lost.exr"});
}

}  // namespace
}  // namespace defray::test::trade_command_test
