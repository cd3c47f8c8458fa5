// defray tune as a user runs it, and what render and splat do with what it found.
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "command/program.h"
#include "tuning/shapes.h"
#include "tuning/tuning_file.h"

namespace defray::test::tune_command_test {
namespace {

using nlohmann::json;

class TuneCommand : public testing::Test {
 protected:
  Folder folder;
  /// A cache folder of its own, but for the kernels that are compiled.
  const std::string own_cache = "env XDG_CACHE_HOME='" + (folder / "cache") +
                                "' POCL_CACHE_DIR=\"${POCL_CACHE_DIR:-$HOME/.cache/pocl/kcache}\"";
  const std::string linear = "tune in.exr --methods linear --kernel linear_psf" + lens;

  void SetUp() override { write_picture_file(folder, "in.exr", {"R", "G", "B", "Z"}); }

  Result run(const std::string& arguments) { return defray(folder, arguments, own_cache); }
  json parsed(const std::string& arguments) {
    const Result result = run(arguments + " --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
  std::string file() const {
    const std::string path = tuning::path_of(tuning::key_of(device_under_test()));
    return folder / ("cache/defray/" + std::filesystem::path(path).filename().string());
  }
  /// As if a tuner had found it.
  void keep(const std::string& frame_class, const std::string& kernel, std::size_t runs = 5,
            const std::string& picture = "a picture") const {
    const tuning::Place place{frame_class, picture, kernel};
    const tuning::Validity correct = tuning::Validity::correct;
    tuning::add(file(), tuning::key_of(device_under_test()), device_under_test().max_work_group,
                {{place, tuning::own_shape(kernel, device_under_test().is_gpu()), correct,
                  std::vector<double>(runs, 9)},
                 {place, {2, 2}, correct, std::vector<double>(runs, 5)}});
  }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) {
    expect_refusal(run(arguments), code, words, arguments);
  }
};

TEST_F(TuneCommand, FindsKeepsShowsExportsAndForgets) {
  const json found = parsed(linear + "--budget 1s -o report");
  ASSERT_EQ(found["kernels"].size(), 1u);
  const json& one = found["kernels"][0];
  EXPECT_EQ(one["kernel"], "linear_psf");
  EXPECT_EQ(one["frames"], "small narrow");
  EXPECT_EQ(one["picture"].get<std::string>().rfind("linear, in.exr, CoC up to", 0), 0u);
  EXPECT_EQ(one["own"], to_string(tuning::own_shape("linear_psf", device_under_test().is_gpu())));
  EXPECT_LE(one["best_ms"], one["own_ms"]);
  EXPECT_GE(one["tried"], 1);
  EXPECT_EQ(found["file"], file());
  EXPECT_TRUE(std::filesystem::exists(folder / "report/index.html"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report/1-linear_psf.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "report/tuning.csv"));

  const json shown = parsed("tune --show");
  EXPECT_EQ(shown, found);
  EXPECT_NE(run("tune --show").out.find("linear_psf"), std::string::npos);
  EXPECT_NE(run("tune --show").out.find("  used\n"), std::string::npos);
  EXPECT_EQ(run("tune --export t4.json").out, "t4.json\n");
  const json exported = json::parse(std::ifstream(folder / "t4.json"));
  EXPECT_EQ(exported["results"].size(), one["tried"].get<std::size_t>());

  // A second run goes on.
  const auto runs = [&] {
    std::size_t count = 0;
    const json kept = json::parse(std::ifstream(file()));
    for (const json& r : kept["results"]) {
      count += r["times"]["runtimes"].size();
    }
    return count;
  };
  const std::size_t before = runs();
  EXPECT_GE(parsed(linear + "--budget 0.1s")["kernels"][0]["tried"], one["tried"]);
  EXPECT_GT(runs(), before);

  // With the times of budgets.
  expect_ok(run("render in.exr -o out.exr --budget-ms 500" + lens));
  const json cleared = parsed("tune --clear");
  ASSERT_EQ(cleared["removed"].size(), 2u);
  EXPECT_EQ(cleared["removed"][0], file());
  EXPECT_FALSE(std::filesystem::exists(std::string(cleared["removed"][1])));
  EXPECT_TRUE(parsed("tune --show")["kernels"].empty());
  expect_refused("tune --export t4.json", 3, {file(), "nothing is tuned, t4.json is not written"});
  EXPECT_EQ(json::parse(std::ifstream(folder / "t4.json")), exported);
  EXPECT_NE(run("tune --show").out.find("nothing is tuned"), std::string::npos);
  EXPECT_NE(run("tune --clear").out.find("was not there"), std::string::npos);
  expect_ok(run("render in.exr -o out.exr --budget-ms 500" + lens));
  EXPECT_NE(run("tune --clear").out.find(": removed"), std::string::npos);
}

TEST_F(TuneCommand, ExportsToFilesOnly) {
  keep("small narrow", "fill");
  expect_ok(shell(folder, "mkfifo pipe"));
  expect_refused("tune --export pipe", 4, {"pipe: is a pipe or a device", "name a file"});
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  expect_refused("tune --export no/t4.json", 4, {"no/t4.json", "No such file or directory"});
}

TEST_F(TuneCommand, ShowsAPicturesKernelsTogether) {
  for (const char* kernel : {"fill", "split"}) {
    for (const char* picture : {"one", "two"}) keep("small narrow", kernel, 5, picture);
  }
  const std::string said = run("tune --show").out;
  EXPECT_LT(said.find("  one; for small"), said.find("  two; for small"));
  EXPECT_EQ(said.find("  one; for small"), said.rfind("  one; for small")) << said;
  EXPECT_EQ(said.find("  two; for small"), said.rfind("  two; for small")) << said;
}

TEST_F(TuneCommand, OfTheBuiltInPicturesTakesTheirNamesAndClasses) {
  const json found = parsed("tune --sizes small --methods linear,splat --budget 0.1s");
  std::set<std::string> classes;
  for (const json& one : found["kernels"]) classes.insert(one["frames"]);
  EXPECT_EQ(classes, (std::set<std::string>{"small cloud", "small narrow", "small wide"}));
}

TEST_F(TuneCommand, KilledLeavesAWholeFile) {
  shell(folder, own_cache + " " + program() + " " + linear + "--budget 60s & job=$!; " +
                    "for i in $(seq 300); do sleep 0.1; grep -qs linear_psf '" + file() +
                    "' && break; done; kill -9 $job; wait $job");
  EXPECT_FALSE(parsed("tune --show")["kernels"].empty());
  EXPECT_EQ(run("tune --show").err, "");
}

TEST_F(TuneCommand, IsUsedByRenderAndSplatUnlessRefused) {
  keep("small narrow", "fill");
  keep("small cloud", "splat_resolve");
  const std::string job = "render in.exr -o out.exr" + lens;
  EXPECT_EQ(parsed(job)["tuned"], json{"fill=2x2"});
  const std::uint64_t tuned = file_hash(folder / "out.exr");
  const std::string stats = run(job + "--stats").out;
  EXPECT_NE(stats.find("tuned: --work-group fill=2x2"), std::string::npos) << stats;
  EXPECT_EQ(parsed(job + "--no-tuning")["tuned"], json::array());
  EXPECT_EQ(file_hash(folder / "out.exr"), tuned);
  EXPECT_EQ(parsed(job + "--work-group fill=8x1")["tuned"], json::array());
  const std::string cloud =
      "splat --model plane --model-points 400 -o c.exr --size 32x32 --focus 3 --fstop 0.5 "
      "--focal-length 50";
  EXPECT_EQ(parsed(cloud)["tuned"], json{"splat_resolve=2x2"});
  EXPECT_EQ(parsed(cloud + " --no-tuning")["tuned"], json::array());
}

/// What a short budget leaves unsure.
TEST_F(TuneCommand, WhatNeedsMoreRunsIsSaid) {
  const std::string line = " more run";
  keep("small narrow", "fill");
  EXPECT_EQ(run("tune --show").out.find(line), std::string::npos);
  EXPECT_EQ(parsed("tune --show")["kernels"][0]["runs_missing"], 0);
  keep("small narrow", "split", 4);
  std::string said = run("tune --show").out;
  EXPECT_NE(said.find("\n  1 of the best is not used yet: up to 1 more run is needed to be sure; "
                      "'defray tune' again, or a larger --budget, goes on from here\n"),
            std::string::npos)
      << said;
  keep("small wide", "split", 2);
  said = run("tune --show").out;
  EXPECT_NE(said.find("  2 of the best are not used yet: up to 3 more runs are needed to be sure"),
            std::string::npos)
      << said;
  EXPECT_EQ(parsed("tune --show")["kernels"][2]["runs_missing"], 3);
  parsed(linear + "--budget 0.01s -o report");
  std::ifstream table(folder / "report/tuning.csv");
  const std::string rows(std::istreambuf_iterator<char>(table), {});
  for (const char* use : {",yes\n", ",no: 1 run is missing\n", ",no: 3 runs are missing\n"}) {
    EXPECT_NE(rows.find(use), std::string::npos) << use << "\n" << rows;
  }
}

TEST_F(TuneCommand, ADamagedFileIsOneNote) {
  keep("small narrow", "fill");
  std::ofstream(file()) << "{\"schema_version\": 1";
  const std::string note = "defray: note: " + file() + ": is damaged and not used";
  for (const std::string& job :
       {"render in.exr -o out.exr" + lens,
        std::string("splat --model plane --model-points 400 -o c.exr --size 32x32 --focus 3 "
                    "--fstop 0.5 --focal-length 50"),
        std::string("tune --show")}) {
    const Result result = run(job);
    EXPECT_EQ(result.code, 0) << job << result.err;
    EXPECT_EQ(result.err.rfind(note, 0), 0u) << job << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.err.find("[json"), std::string::npos) << result.err;
  }
  EXPECT_EQ(run("render in.exr -o out.exr -q" + lens).err, "");
  EXPECT_EQ(run("render in.exr -o out.exr --no-tuning" + lens).err, "");
}

TEST_F(TuneCommand, RefusesWhatMeansNothing) {
  expect_refused("tune --budget 0s", 2, {"--budget '0s'", "90s, 10m or 1h"});
  expect_refused("tune --budget nan", 2, {"--budget 'nan'"});
  expect_refused("tune --budget 1d", 2, {"--budget '1d'"});
  expect_refused("tune --kernel fil", 2, {"--kernel", "'fil'", "'fill'"});
  expect_refused("tune --methods tiltshift", 2,
                 {"--methods 'tiltshift'", "rdb gather linear splat"});
  expect_refused("tune in.exr --methods splat" + lens, 2, {"splat", "point cloud"});
  expect_refused("tune --sizes huge", 2, {"--sizes 'huge'", "small hd uhd"});
  expect_refused("tune --show --clear", 2, {"--show, --clear and --export: one of them"});
  expect_refused("tune in.exr --show", 2, {"go without a picture"});
  expect_refused("tune --clear -o report", 2, {"--output", "goes without --show"});
  expect_refused("tune --show --kernel fill", 2, {"--kernel", "goes without --show"});
  expect_refused("tune --export t4.json --budget 5s", 2, {"--budget", "goes without --show"});
  expect_refused("tune --device reference", 2, {"reference", "no work-groups"});
  expect_refused("tune --focus 3", 2, {"--focus", "goes with a picture"});
  expect_refused("tune in.exr --sizes hd" + lens, 2, {"--sizes", "goes without a picture"});
  expect_refused("tune none.exr" + lens, 3, {"none.exr"});
  expect_refused("tune --kernel rdb_scatter --methods linear --sizes small --budget 0.01s", 2,
                 {"--kernel rdb_scatter", "--methods linear"});
}

TEST_F(TuneCommand, NeedsAFolderThatCanBeWritten) {
  std::ofstream(folder / "file") << "no folder";
  const std::string cache = "POCL_CACHE_DIR=\"${POCL_CACHE_DIR:-$HOME/.cache/pocl/kcache}\" ";
  const Result refused =
      defray(folder, linear + "--budget 9m", cache + "XDG_CACHE_HOME='" + (folder / "file") + "'");
  expect_refusal(refused, 4, {folder / "file"}, linear);
  const Result homeless = defray(folder, "tune --show", "env -u XDG_CACHE_HOME -u HOME " + cache);
  expect_refusal(homeless, 4, {"set XDG_CACHE_HOME or HOME"}, "tune --show");
}

}  // namespace
}  // namespace defray::test::tune_command_test
