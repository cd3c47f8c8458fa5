// render --budget-ms as a user runs it.
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"

namespace defray::test::budget_command_test {
namespace {

using nlohmann::json;

class BudgetCommand : public testing::Test {
 protected:
  Folder folder;
  const std::string kernels = "POCL_CACHE_DIR=\"${POCL_CACHE_DIR:-$HOME/.cache/pocl/kcache}\" ";
  const std::string own_cache = "env " + kernels + "XDG_CACHE_HOME='" + (folder / "cache") + "'";
  const std::string job = "render in.exr -o out.exr" + lens;

  void SetUp() override { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }

  json rendered(const std::string& options, const std::string& cache = "") {
    const Result result =
        defray(folder, job + options + " --json", cache.empty() ? own_cache : cache);
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
  /// Of the only file of times in the cache.
  std::string file() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cache/defray")) {
      if (entry.path().extension() == ".json") return entry.path();
    }
    return "";
  }
};

TEST_F(BudgetCommand, TakesTheBestInTheTimeAndSaysHowToRepeatIt) {
  const json rich = rendered("--budget-ms 60000");
  EXPECT_EQ(rich["budget"]["quality"], "high");
  EXPECT_EQ(rich["budget"]["rdb"], 33);
  EXPECT_EQ(rich["budget"]["budget_ms"], 60000.0);
  EXPECT_LT(rich["budget"]["expected_ms"], 60000.0);
  EXPECT_EQ(rich["notes"], json::array());
  const std::uint64_t made = file_hash(folder / "out.exr");
  EXPECT_FALSE(rendered("--quality high --rdb 33").contains("budget"));
  EXPECT_EQ(file_hash(folder / "out.exr"), made);

  const json poor = rendered("--budget-ms 0.001");
  EXPECT_EQ(poor["budget"]["quality"], "preview");
  EXPECT_EQ(poor["budget"]["rdb"], 6);
  const std::string note = poor["notes"][0];
  EXPECT_EQ(note.rfind("--budget-ms of 0.001: the fastest quality, preview, takes about ", 0), 0u);
  const std::uint64_t preview = file_hash(folder / "out.exr");
  rendered("--quality preview");
  EXPECT_EQ(file_hash(folder / "out.exr"), preview);

  const Result text = defray(folder, job + "--budget-ms 60000", own_cache);
  EXPECT_NE(text.out.find("\n  --quality high --rdb 33: "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find(" taken, of 6e+04\n"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("the same again"), std::string::npos) << text.out;

  // The whole command, with --stats.
  const Result stats = defray(folder, job + "--stats --budget-ms 60000", own_cache);
  const std::string marker = "  the same again: defray ";
  const std::size_t at = stats.out.find(marker);
  ASSERT_NE(at, std::string::npos) << stats.out;
  const std::string again = stats.out.substr(at + marker.size());
  std::filesystem::remove(folder / "out.exr");
  expect_ok(defray(folder, again.substr(0, again.find('\n'))));
  EXPECT_EQ(file_hash(folder / "out.exr"), made);
}

TEST_F(BudgetCommand, LearnsFromRunToRun) {
  const json first = rendered("--budget-ms 60000"), second = rendered("--budget-ms 60000");
  const double expected = first["budget"]["expected_ms"], learnt = second["budget"]["expected_ms"];
  const double taken = 1000 * first["render_s"].get<double>();
  EXPECT_NE(learnt, expected);
  EXPECT_EQ(learnt > expected, taken > expected) << learnt << " " << expected << " " << taken;
  ASSERT_NE(file(), "");
  // Without a budget nothing is kept.
  std::filesystem::remove(file());
  rendered("--quality draft");
  EXPECT_EQ(file(), "");
}

TEST_F(BudgetCommand, AFileThatCannotBeUsedOrWrittenIsANote) {
  rendered("--budget-ms 60000");
  std::ofstream(file()) << "{";
  const json damaged = rendered("--budget-ms 60000");
  ASSERT_EQ(damaged["notes"].size(), 1u);
  EXPECT_NE(damaged["notes"][0].get<std::string>().find("is damaged and not used"),
            std::string::npos);
  EXPECT_EQ(rendered("--budget-ms 60000")["notes"], json::array());
  std::ofstream(folder / "file") << "no folder";
  const json read_only = rendered("--budget-ms 60000",
                                  "env " + kernels + "XDG_CACHE_HOME='" + (folder / "file") + "'");
  ASSERT_EQ(read_only["notes"].size(), 1u);
  EXPECT_EQ(
      read_only["notes"][0].get<std::string>().rfind("times are not kept for other runs: ", 0), 0u);
}

TEST_F(BudgetCommand, RefusesWhatMeansNothing) {
  const auto refuses = [&](const std::string& options, const std::vector<std::string>& words) {
    expect_refusal(defray(folder, job + options), 2, words, options);
  };
  refuses("--budget-ms 0", {"--budget-ms is 0", "finite number of milliseconds above 0"});
  refuses("--budget-ms -5", {"--budget-ms is -5"});
  refuses("--budget-ms inf", {"--budget-ms is inf"});
  refuses("--budget-ms nan", {"--budget-ms is nan"});
  refuses("--budget-ms 50 --quality draft", {"--budget-ms goes without --quality"});
  refuses("--budget-ms 50 --rdb 9", {"--budget-ms goes without"});
  refuses("--budget-ms 50 --target-db 40", {"--budget-ms goes without", "--target-db"});
  refuses("--budget-ms 50 --literal", {"--budget-ms means nothing to --literal"});
  refuses("--budget-ms 50 --method gather", {"--budget-ms means nothing to --method gather"});
  refuses("--budget-ms 50 --device reference", {"--budget-ms", "reference"});
}

}  // namespace
}  // namespace defray::test::budget_command_test
