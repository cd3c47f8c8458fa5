// defray-perf report: tables stand between their markers, and nothing else changes.
#include <cstdlib>
#include <fstream>
#include <regex>

#include "command/program.h"
#include "tuning/shapes.h"
#include "tuning/tuning_file.h"

#ifndef DEFRAY_PERF_PROGRAM
#define DEFRAY_PERF_PROGRAM ""  // built without the benchmarks
#endif

namespace defray::test::report_command_test {
namespace {

class ReportCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(DEFRAY_PERF_PROGRAM).empty()) GTEST_SKIP() << "built without the benchmarks";
  }
  /// Mesa's device takes ten times as long as PoCL's: left out.
  Result report(const std::string& arguments) {
    return shell(folder, "RUSTICL_ENABLE= '" DEFRAY_PERF_PROGRAM "' report " + arguments);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  std::string text_of(const std::string& name) {
    std::ifstream stream(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What stands between a table's markers.
  std::string table_in(const std::string& name, const std::string& table) {
    const std::string text = text_of(name), begin = "<!-- " + table + ":begin -->\n";
    const std::size_t from = text.find(begin) + begin.size();
    return text.substr(from, text.find("<!-- " + table + ":end -->") - from);
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) {
    expect_refusal(report(arguments), code, words, arguments);
  }
  Folder folder;
};

std::string marked(const std::string& table, const std::string& content = "") {
  return "<!-- " + table + ":begin -->\n" + content + "<!-- " + table + ":end -->\n";
}

TEST_F(ReportCommand, RooflineHasAKernelsTimesInEachPicture) {
  SKIP_UNLESS_FULL();
  write("a.md", marked("roofline"));
  expect_ok(report("--update a.md --table roofline --quick"));
  const std::string table = table_in("a.md", "roofline");
  EXPECT_EQ(table.rfind("| kernel | fence bg | spheres f2 | points, 512×512 |\n", 0), 0u) << table;
  const std::regex row("\n\\| `split` \\| [0-9.]+ \\(× [0-9.]+\\) \\| [0-9.]+ \\(× [0-9.]+\\) \\|");
  EXPECT_TRUE(std::regex_search(table, row)) << table;
  const std::regex points("\n\\| `splat_resolve` \\|  \\|  \\| [0-9.]+ \\(× [0-9.]+\\) \\|");
  EXPECT_TRUE(std::regex_search(table, points)) << table;
  EXPECT_NE(table.find(" GB/s."), std::string::npos) << table;
}

TEST_F(ReportCommand, TuningIsWhatTheDevicesFileHolds) {
  const std::string cache = folder / "cache";
  const auto tuned = [&] {
    write("a.md", marked("tuning"));
    expect_ok(shell(folder, "XDG_CACHE_HOME='" + cache +
                                "' POCL_CACHE_DIR=\"${POCL_CACHE_DIR:-$HOME/.cache/pocl/kcache}\" "
                                "RUSTICL_ENABLE= '" DEFRAY_PERF_PROGRAM
                                "' report --update a.md --table tuning"));
    return table_in("a.md", "tuning");
  };
  EXPECT_NE(tuned().find("\nNothing is tuned: run `defray tune`.\n"), std::string::npos);
  const tuning::Key key = tuning::key_of(device_under_test());
  const std::string file = std::filesystem::path(tuning::path_of(key)).filename();
  const tuning::Place place{"hd narrow", "a picture", "fill"};
  tuning::add(cache + "/defray/" + file, key, device_under_test().max_work_group,
              {{place,
                tuning::own_shape("fill", device_under_test().is_gpu()),
                tuning::Validity::correct,
                {10, 10, 10, 10, 10}},
               {place, {2, 2}, tuning::Validity::correct, {8, 8, 8, 8, 8}}});
  const std::string table = tuned();
  EXPECT_NE(table.find("\n| a picture | `fill` | " +
                       to_string(tuning::own_shape("fill", device_under_test().is_gpu())) +
                       " | 10.0 | 2x2 | 8.0 | 20 % (20 to 20) | yes |\n"),
            std::string::npos)
      << table;
}

TEST_F(ReportCommand, UpdateChangesOnlyWhatStandsBetweenItsMarkers) {
  const std::string head = "# Title\r\n\tas it is, <!-- motion:begin --> too  \n\n";
  const std::string middle = "\nbetween\n" + marked("left", "| kept |\n") + "\n";
  const std::string tail = "no line end\xff";
  write("a.md", head + marked("motion", "old\nlines\n") + middle + tail);
  const Result result = report("--update a.md --table motion --quick");
  expect_ok(result);
  EXPECT_EQ(result.out, "a.md: motion\n");
  const std::string table = table_in("a.md", "left");
  EXPECT_EQ(table, "| kept |\n");
  const std::string text = text_of("a.md");
  ASSERT_EQ(text.substr(0, head.size()), head);
  ASSERT_EQ(text.substr(text.size() - tail.size() - middle.size()), middle + tail);
  const std::string written =
      text.substr(head.size(), text.size() - head.size() - middle.size() - tail.size());
  EXPECT_EQ(written.find("old"), std::string::npos);
  EXPECT_EQ(written.find("<!-- motion:begin -->\n| focus | truth's change | pinhole |"), 0u);
  EXPECT_NE(written.find("\n|---|---|---|---|---|---|---|---|\n| drift face | "),
            std::string::npos);
  EXPECT_NE(written.find("\nMeasured on "), std::string::npos);
  EXPECT_NE(written.find("\nA rehearsal"), std::string::npos);
  EXPECT_NE(written.find("\n<!-- motion:end -->\n"), std::string::npos);
}

TEST_F(ReportCommand, MeasuresEveryTableWhoseMarkersStandThere) {
  SKIP_UNLESS_FULL();
  expect_ok(defray(folder, "scene plate1 -o scenes/own --width 64 --height 48 --truth-samples 4"));
  expect_ok(shell(folder, "mv scenes/own/truth.exr scenes/own/truth_default.exr"));
  write("a.md", marked("accuracy") + marked("validate") + marked("speed"));
  const Result result = report("--update a.md --quick --scenes scenes");
  expect_ok(result);
  EXPECT_EQ(result.out, "a.md: accuracy\na.md: validate\na.md: speed\n");
  const std::string accuracy = table_in("a.md", "accuracy");
  EXPECT_EQ(accuracy.find("| method | plate1 | own default |\n|---|---|---|\n| pinhole | "), 0u);
  EXPECT_NE(accuracy.find("\n| linear | "), std::string::npos);
  EXPECT_NE(accuracy.find(" s) |\n"), std::string::npos);
  EXPECT_NE(table_in("a.md", "validate").find(" pass, "), std::string::npos);
  EXPECT_NE(table_in("a.md", "speed").find("| scalar twin, one thread | "), std::string::npos);
}

TEST_F(ReportCommand, ScriptsPutTheirTablesBetweenTheirMarkers) {
  SKIP_UNLESS_FULL();
  std::ofstream(folder / "own.py") << "import sys\n"
                                      "sys.path.insert(0, '" DEFRAY_SOURCE_DIR
                                      "/perf/scripts')\n"
                                      "from table import Table\n"
                                      "table = Table('what', 'how much')\n"
                                      "table.row('one', '1')\n"
                                      "table.update(sys.argv[1], 'own.py')\n";
  const std::string rows = "| what | how much |\n|---|---|\n| one | 1 |\n";
  write("a.md", "Before\n" + marked("own.py", "old\n") + marked("speed", "kept\n") + "After\n");
  const Result result = shell(folder, "python3 own.py a.md");
  expect_ok(result);
  EXPECT_EQ(result.out, rows);
  EXPECT_EQ(text_of("a.md"),
            "Before\n" + marked("own.py", rows) + marked("speed", "kept\n") + "After\n");
  // Those of scripts are no tables of `report`'s, nor the other way round.
  expect_refused("--update a.md --table own.py", 2, {"table 'own.py' is not known"});
  write("b.md", marked("speed"));
  const Result none = shell(folder, "python3 own.py b.md");
  EXPECT_EQ(none.code, 1);
  EXPECT_EQ(none.err,
            "b.md: has no markers '<!-- own.py:begin -->' and '<!-- own.py:end -->' around one "
            "place\n");
  EXPECT_EQ(text_of("b.md"), marked("speed"));
}

TEST_F(ReportCommand, RefusesWhatItCannotDo) {
  write("a.md", "# Title\n");
  expect_refused("--update a.md", 3, {"a.md", "has no markers", "accuracy"});
  expect_refused("--update b.md", 3, {"b.md", "no such file"});
  expect_refused("--update .", 3, {".: is a folder"});
  expect_refused("--update a.md --table motoin", 2, {"motoin", "Did you mean 'motion'"});
  expect_refused("", 2, {"--update"});
  write("a.md", marked("motion"));
  expect_refused("--update a.md --table left", 3, {"a.md", "no markers of table 'left'", "motion"});
  expect_refused("--update a.md --scenes nowhere", 3, {"nowhere", "no such folder"});
  expect_refused("--update a.md --device nothing", 5, {"nothing"});
  EXPECT_EQ(text_of("a.md"), marked("motion"));
}

TEST_F(ReportCommand, RefusesMarkersThatAreWrong) {
  write("a.md", marked("accuracies"));
  expect_refused("--update a.md", 3, {"a.md", "accuracies", "Did you mean 'accuracy'"});
  write("a.md", "<!-- left:begin -->\n<!-- motion:end -->\n");
  expect_refused("--update a.md", 3, {"a.md", "left:begin", "no end that follows"});
  write("a.md", "<!-- left:end -->\n<!-- left:begin -->\n");
  expect_refused("--update a.md", 3, {"a.md", "left:end", "no begin before it"});
  write("a.md", marked("left") + marked("left"));
  expect_refused("--update a.md", 3, {"a.md", "left", "twice"});
}

TEST_F(ReportCommand, HelpListsTheTables) {
  const Result help = report("--help");
  expect_ok(help);
  for (const std::string name : {"accuracy", "methods", "stages", "left", "motion", "papers",
                                 "arithmetic", "validate", "speed", "roofline", "Example"}) {
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace defray::test::report_command_test
