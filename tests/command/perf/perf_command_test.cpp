// defray-perf: every experiment runs and leaves a report whose parts are all there.
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "command/program.h"

#ifndef DEFRAY_PERF_PROGRAM
#define DEFRAY_PERF_PROGRAM ""  // built without the benchmarks
#endif

namespace defray::test::perf_command_test {
namespace {

class PerfCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(DEFRAY_PERF_PROGRAM).empty()) GTEST_SKIP() << "built without the benchmarks";
  }
  Result perf(const std::string& arguments) {
    return shell(folder, "'" DEFRAY_PERF_PROGRAM "' " + arguments);
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) {
    expect_refusal(perf(arguments), code, words, arguments);
  }
  /// Of a rehearsal of all experiments, which all tests that look at one share.
  static const Folder& all() {
    static const Folder folder;
    static const Result result =
        shell(folder, "'" DEFRAY_PERF_PROGRAM "' experiment all -o report --quick");
    expect_ok(result);
    EXPECT_EQ(result.err, "");  // no progress without a terminal
    return folder;
  }
  static std::string text_of(const std::string& name) {
    std::ifstream stream(all() / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  Folder folder;
};

TEST_F(PerfCommand, AllExperimentsLeaveOneCompleteReport) {
  SKIP_UNLESS_FULL();
  const std::string html = text_of("report/index.html");
  for (const std::string part :
       {"Plate 1", "Plate 2", "Figure 7", "The eye", "Error against time", "Where the time goes",
        "Closer to truth", "Edges that are not there", "defray render spheres/pinhole.exr",
        "</html>"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  std::size_t links = 0;
  const std::regex link("(?:src|href)=\"([^\"]+)\"");
  for (std::sregex_iterator i(html.begin(), html.end(), link), end; i != end; ++i, ++links) {
    const std::filesystem::path file = all() / ("report/" + (*i)[1].str());
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_GT(std::filesystem::file_size(file), 50u) << file;
  }
  EXPECT_GT(links, 20u);
  EXPECT_NE(html.find("rehearsal"), std::string::npos);
  EXPECT_EQ(text_of("report/plate1.csv").substr(0, 7), "method,");
}

TEST_F(PerfCommand, RooflineHasEachKernelsTimeAndBytes) {
  SKIP_UNLESS_FULL();
  for (const std::string scene : {"fence", "spheres"}) {
    EXPECT_TRUE(std::filesystem::exists(all() / ("report/roofline-" + scene + ".png")));
    const std::string csv = text_of("report/roofline-" + scene + ".csv");
    std::map<std::string, std::array<double, 4>> kernels;
    const std::regex row("\n([a-z_]+),([0-9.]+),([0-9.]+),([0-9.]+),([0-9.]+)");
    for (std::sregex_iterator i(csv.begin(), csv.end(), row), end; i != end; ++i) {
      for (std::size_t k = 0; k < 4; ++k) kernels[(*i)[1]][k] = std::stod((*i)[k + 2]);
    }
    for (const std::string kernel : {"coc", "mixed", "fill", "split", "soften", "rdb_gather"}) {
      ASSERT_TRUE(kernels.contains(kernel)) << csv;
      const auto [took_ms, megabytes, least_ms, ratio] = kernels[kernel];
      EXPECT_GT(took_ms, 0) << kernel;
      EXPECT_GT(ratio, 0) << kernel;
    }
    // Depth in, CoC out: 480 x 270 pixels.
    EXPECT_NEAR(kernels["coc"][1], 2 * 4e-6 * 480 * 270, 0.06);
    // As the frame, what lies behind it, and two layers of both.
    EXPECT_NEAR(kernels["split"][1] / kernels["coc"][1], (6 + 5 + 12) / 2.0, 2.5);
  }
}

TEST_F(PerfCommand, TruthHasARowForEachMechanismAndAColumnForEachScene) {
  SKIP_UNLESS_FULL();
  const std::string mechanisms = text_of("report/truth-mechanisms.csv");
  for (const std::string row : {"pinhole,", "literal RDB 9x9,", "default,", "--hidden off,",
                                "--hidden fill,", "--split off,", "--highlights rays,",
                                "--border renormalise,", "--repair off,", "--quality high,"}) {
    EXPECT_NE(mechanisms.find("\n" + row), std::string::npos) << row;
  }
  for (const std::string table : {"mechanisms", "cost", "split"}) {
    const std::string csv = text_of("report/truth-" + table + ".csv");
    const std::string head = csv.substr(0, csv.find('\n'));
    EXPECT_NE(head.find("fence bg,fence fence,spheres f2,spheres f5,plate1"), std::string::npos)
        << head;
    EXPECT_EQ(csv.find("nan"), std::string::npos);
  }
  EXPECT_EQ(text_of("report/truth-motion.csv").substr(0, 6), "focus,");
  for (const std::string picture : {"fence-bg", "spheres-f5", "plate1-default", "motion"}) {
    EXPECT_TRUE(std::filesystem::exists(all() / ("report/truth-" + picture + ".png")));
  }
}

TEST_F(PerfCommand, TradeoffsCommandsGiveItsFigures) {
  SKIP_UNLESS_FULL();
  std::smatch first;
  const std::string html = text_of("report/index.html");
  ASSERT_TRUE(std::regex_search(html, first, std::regex("First: defray (scene fence [^<]*[0-9])")));
  expect_ok(defray(folder, first[1].str()));
  const std::string csv = text_of("report/tradeoff-fence.csv");
  const std::regex row("([^\n]*) s [^,\n]*,([0-9.]+),[^\n]*,defray (render [^\n]*)");
  int rows = 0;
  for (std::sregex_iterator i(csv.begin(), csv.end(), row), end; i != end; ++i, ++rows) {
    expect_ok(defray(folder, (*i)[3].str()));
    const Result compared = defray(folder, "compare fence/out.exr fence/truth_bg.exr --json");
    expect_ok(compared);
    const double psnr_db = nlohmann::json::parse(compared.out)["psnr_srgb_db"];
    EXPECT_NEAR(psnr_db, std::stod((*i)[2].str()), 0.01) << (*i)[3].str();
  }
  EXPECT_EQ(rows, 5);
}

TEST_F(PerfCommand, SilhouettesOfGivenScenesAreThoseThatCompareFinds) {
  SKIP_UNLESS_FULL();
  expect_ok(defray(folder, "scene fence -o mine/fence --width 160 --height 100 --truth-samples 4"));
  expect_ok(perf("experiment silhouettes -o report --quick --scenes mine"));
  std::ifstream stream(folder / "report/silhouettes.csv");
  const std::string csv{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t given = csv.rfind("\nfence bg,");
  ASSERT_GT(given, csv.find("\nfence bg,")) << csv;  // the built-in one comes first
  std::smatch row;
  const std::string line = csv.substr(given + 1, csv.find('\n', given + 1) - given);
  ASSERT_TRUE(
      std::regex_search(line, row, std::regex("\"([0-9.]+), ([0-9.]+); ([0-9.]+) dB\"\n?$")))
      << line;
  expect_ok(defray(folder,
                   "render mine/fence/pinhole.exr -o out.exr --camera mine/fence/camera.json "
                   "--focus-setting bg"));
  const Result compared =
      defray(folder, "compare out.exr mine/fence/truth_bg.exr --false-edges --json");
  expect_ok(compared);
  const nlohmann::json json = nlohmann::json::parse(compared.out);
  EXPECT_NEAR(json["false_edges"]["rms"].get<double>(), std::stod(row[1]), 0.01);
  EXPECT_NEAR(json["false_edges"]["p999"].get<double>(), std::stod(row[2]), 0.1);
  EXPECT_NEAR(json["psnr_srgb_db"].get<double>(), std::stod(row[3]), 0.05);
  // Two crops a setting, where there are so many, none written over.
  int crops = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "report")) {
    crops += file.path().filename().string().find("-fence-bg.png") != std::string::npos;
  }
  EXPECT_EQ(crops, 4);
}

TEST_F(PerfCommand, RefusesWhatItCannotDo) {
  expect_refused("experiment plat1 -o report", 2, {"plat1", "Did you mean 'plate1'", "tradeoff"});
  expect_refused("experiment all plat2 -o report", 2, {"plat2"});
  expect_refused("experiment plate1 -o ''", 2, {"--output", "is empty"});
  expect_refused("experiment plate1 -o /proc/none", 4, {"/proc/none"});
  expect_refused("experiment plate1", 2, {"--output"});
  expect_refused("experiment plate1 -o report --device nothing", 5, {"nothing"});
  expect_refused("experiment plate1 -o report --scenes .", 2, {"--scenes", "silhouettes"});
  expect_refused("experiment silhouettes -o report --scenes none", 3, {"none: no such folder"});
  expect_refused("experimnt plate1 -o out", 2, {"ubcommand"});
}

TEST_F(PerfCommand, HelpListsTheExperiments) {
  const Result help = perf("experiment --help");
  expect_ok(help);
  for (const std::string name : {"plate1", "plate2", "figure7", "eye", "tradeoff", "roofline",
                                 "silhouettes", "truth", "Example"}) {
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace defray::test::perf_command_test
