// defray validate from the command line: what it writes, says, refuses, and how its exit code goes.
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/program.h"
#include "validate/case_command.h"
#include "validation/case.h"

namespace defray::test::validate_command_test {
namespace {

using nlohmann::json;

const std::string two_kernels = "validate --kernel coc --kernel rdb_merge -o report ";

struct ValidateCommand : testing::Test {
  Folder folder;

  std::string text_of(const std::string& name) const {
    std::ifstream stream(folder / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  json report() const { return json::parse(text_of("report/report.json")); }
  void expect_refused(const std::string& arguments, int code,
                      const std::vector<std::string>& words) const {
    expect_refusal(defray(folder, "validate " + arguments), code, words, arguments);
    EXPECT_FALSE(std::filesystem::exists(folder / "none/report.html")) << arguments;
  }
  /// Runs a command that a report gives; its results go to the folder "case".
  Result again(std::string command) const {
    const std::size_t name = command.find("defray ");
    EXPECT_NE(name, std::string::npos) << command;
    return shell(folder, command.replace(name, 6, program()));
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ValidateCommand, WritesBothReportsAndPasses) {
  const Result result = defray(folder, two_kernels);
  expect_ok(result);
  EXPECT_TRUE(contains(result.out, "PASS  rdb_merge")) << result.out;
  EXPECT_TRUE(contains(result.out, "report/report.html\nreport/report.json\n2 of 2 checks pass, "))
      << result.out;
  EXPECT_TRUE(result.out.ends_with(" cases\n")) << result.out;
  EXPECT_TRUE(contains(text_of("report/report.html"), " checks pass, "));
  const json all = report();
  EXPECT_EQ(all["level"], "quick");
  ASSERT_EQ(all["devices"].size(), 1u);
  const json& device = all["devices"][0];
  EXPECT_EQ(device["passed"], true);
  EXPECT_EQ(device["math"], "strict");
  EXPECT_FALSE(device["version"].get<std::string>().empty());
  ASSERT_EQ(device["kernels"].size(), 2u);
  for (const json& kernel : device["kernels"]) {
    for (const char* field :
         {"kernel", "rule", "passed", "cases", "values", "differing", "beyond_rule", "worst",
          "worst_unit", "exact_share_of_bound", "unstable_cases", "hash", "seconds"}) {
      EXPECT_TRUE(kernel.contains(field)) << field;
    }
    EXPECT_GT(kernel["values"], 10000);
    EXPECT_GT(kernel["exact_share_of_bound"], 0);
    EXPECT_LE(kernel["exact_share_of_bound"], 1);
  }
}

TEST_F(ValidateCommand, OfFloatsEachValueHasItsDistance) {
  expect_ok(defray(folder, "validate -o report --kernel linear_psf"));
  const json floats = report()["devices"][0]["kernels"][0];
  std::uint64_t counted = 0;
  for (const auto& [bin, count] : floats["ulp_histogram"].items()) counted += count.get<int>();
  EXPECT_EQ(counted, floats["values"]);
}

TEST_F(ValidateCommand, ACaseRunsAgainByItsCommand) {
  expect_ok(defray(folder, two_kernels));
  const json coc = report()["devices"][0]["kernels"][0];
  ASSERT_TRUE(coc.contains("worst_case")) << coc;
  expect_ok(again(coc["worst_case"]));
  const json repeated = json::parse(text_of("case/report.json"))["devices"][0]["kernels"][0];
  EXPECT_EQ(repeated["cases"], 1);
  EXPECT_EQ(repeated["worst"], coc["worst"]);
  EXPECT_EQ(repeated["worst_case"], coc["worst_case"]);
}

TEST_F(ValidateCommand, TinyTakesFewerCasesAndSaysSo) {
  const auto run = [&](const std::string& level) {
    expect_ok(defray(folder, "validate --kernel coc -o report " + level));
    return report();
  };
  const json tiny = run("--tiny"), quick = run("");
  EXPECT_EQ(tiny["level"], "tiny");
  EXPECT_EQ(quick["level"], "quick");
  const auto cases = [](const json& r) { return r["devices"][0]["kernels"][0]["cases"]; };
  EXPECT_GT(cases(tiny), 10);
  EXPECT_LT(cases(tiny), cases(quick));
}

TEST_F(ValidateCommand, JsonPrintsTheReportAlone) {
  const Result result = defray(folder, two_kernels + "--json --case 13x7,ties");
  expect_ok(result);
  EXPECT_EQ(result.out, text_of("report/report.json"));
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(defray(folder, two_kernels + "-q --case 13x7,ties").out, "");
}

TEST_F(ValidateCommand, FastArithmeticsReportAgreesWithItsExitCode) {
  const Result result = defray(folder, two_kernels + "--math fast");
  const json device = report()["devices"][0];
  EXPECT_EQ(device["math"], "fast");
  EXPECT_EQ(result.code, device["passed"] ? 0 : 1);
  EXPECT_EQ(contains(result.out, " of 2 checks FAIL, "), result.code == 1) << result.out;
  bool all_pass = true;
  for (const json& kernel : device["kernels"]) {
    const bool passed = kernel["passed"];
    all_pass = all_pass && passed;
    EXPECT_EQ(passed, kernel["beyond_rule"] == 0 && kernel["unstable_cases"] == 0) << kernel;
    const std::string line = (passed ? "PASS  " : "FAIL  ") + kernel["kernel"].get<std::string>();
    EXPECT_TRUE(contains(result.out, line)) << line << "\n" << result.out;
    if (kernel.contains("first_wrong")) {
      EXPECT_EQ(again(kernel["first_wrong"]).code, 1) << kernel["first_wrong"];
      EXPECT_TRUE(contains(result.out, kernel["first_wrong"])) << result.out;
    }
  }
  EXPECT_EQ(device["passed"], all_pass);
  EXPECT_EQ(contains(text_of("report/report.html"), " checks FAIL, "), !all_pass);
}

TEST_F(ValidateCommand, RefusesWhatMakesNoSense) {
  expect_refused("", 2, {"--output"});
  expect_refused("-o ''", 2, {"--output", "is empty"});
  expect_refused("-o none --device ''", 2, {"--device", "is empty"});
  expect_refused("-o none --device nonesuch", 5, {"nonesuch", "found:"});
  expect_refused("-o none --kernel rdb_mrege", 2, {"Did you mean 'rdb_merge'", "tiltshift"});
  expect_refused("-o none --case 64x48,spars", 2, {"'spars'", "Did you mean 'sparse'"});
  expect_refused("-o none --case 64x", 2, {"64x"});
  expect_refused("-o none --case ''", 2, {"--case", "empty"});
  expect_refused("-o none --math fats", 2, {"fats", "Did you mean 'fast'"});
  expect_refused("-o none --kernel coc --quick --full", 2, {"--quick", "--full"});
  expect_refused("-o none --kernel coc --tiny --full", 2, {"--tiny", "--full"});
  expect_refused("-o none --all --device 0", 2, {"--all", "--device"});
  expect_refused("-o none --arithmetic --all", 2, {"--arithmetic", "--all"});
  expect_refused("-o none --arithmetic --kernel coc", 2, {"--arithmetic", "--kernel"});
  expect_refused("-o none --arithmetic --case 1x1", 2, {"--arithmetic", "--case"});
  expect_refused("-o none --arithmetic --math fast", 2, {"--arithmetic", "--math"});
  expect_refused("-o none --case 64x48 --full", 2, {"--case", "--full"});
  expect_refused("-o none --case 64x48,group=4096x4096", 2, {"work-items", "allows at most"});
}

TEST_F(ValidateCommand, AFolderThatCannotBeWrittenIsSaidAtOnce) {
  std::ofstream(folder / "file") << "no folder";
  expect_refused("-o file --kernel coc", 4, {"file: cannot create this folder"});
  expect_refused("-o file/report --kernel coc", 4, {"file/report"});
  expect_refused("-o /proc/none --kernel coc", 4, {"/proc/none"});
}

TEST_F(ValidateCommand, KernelsMayBeListedAndRepeated) {
  const Result result = defray(folder, "validate --kernel coc,rdb_clear --kernel coc -o report");
  expect_ok(result);
  EXPECT_EQ(report()["devices"][0]["kernels"].size(), 2u);
}

TEST_F(ValidateCommand, AnInterruptedRunLeavesNothingBehind) {
  std::filesystem::create_directory(folder / "tmp");
  const Result result =
      shell(folder, "TMPDIR=tmp timeout -s INT 1 " + program() + " validate --full -o report");
  EXPECT_EQ(result.code, 124) << result.err;
  // A busy machine may not even have come to the report's folder.
  EXPECT_EQ(shell(folder, "mkdir -p report; ls -A tmp report").out, "report:\n\ntmp:\n");
}

/// OCL_ICD_VENDORS=…: a folder with PoCL's entry alone.
std::string pocl_alone(const Folder& folder) {
  const Result copy = shell(folder, "mkdir icd && cp /etc/OpenCL/vendors/pocl.icd icd/");
  return copy.code == 0 ? "OCL_ICD_VENDORS='" + (folder / "icd") + "'" : "";
}

TEST_F(ValidateCommand, AllSaysWhatItCouldNotTry) {
  const std::string vendors = pocl_alone(folder);
  if (vendors.empty()) GTEST_SKIP() << "PoCL's entry is not in /etc/OpenCL/vendors";
  const Result result = defray(folder, two_kernels + "--all --case 13x7,ties", vendors);
  expect_ok(result);
  const json all = report();
  ASSERT_EQ(all["devices"].size(), 1u);
  ASSERT_EQ(all["notes"].size(), 2u);
  for (const char* package : {"mesa-opencl-icd", "oclgrind"}) {
    EXPECT_TRUE(contains(result.out, std::string("apt-get install ") + package)) << result.out;
    EXPECT_TRUE(contains(all["notes"].dump(), package)) << all["notes"];
    EXPECT_TRUE(contains(text_of("report/report.html"), package));
  }
  EXPECT_FALSE(contains(result.out, "install pocl")) << result.out;
}

TEST_F(ValidateCommand, NoDeviceIsAnErrorThatNamesThePackage) {
  const std::string none = "OCL_ICD_VENDORS='" + folder.path() + "'";
  for (const std::string arguments : {"validate -o none", "validate --all -o none"}) {
    expect_refusal(defray(folder, arguments, none), 5, {"pocl-opencl-icd"}, arguments);
  }
}

TEST_F(ValidateCommand, HelpShowsExamplesThatHold) {
  const std::string help = defray(folder, "validate --help").out;
  for (const std::string part : {"defray validate -o report", "--all --full", "--arithmetic",
                                 "Exit code: 0 all pass, 1 a kernel fails"}) {
    EXPECT_TRUE(contains(help, part)) << part << " is not in\n" << help;
  }
  const std::size_t begin = help.find("--case 2") + 7;
  ASSERT_GT(begin, 7u);
  EXPECT_NO_THROW(validation::parse_case(help.substr(begin, help.find(' ', begin) - begin)));
}

TEST(ValidateCommands, SayHowToReachTheDevice) {
  validation::DeviceResult device;
  device.device = "llvmpipe (LLVM)";
  device.math = "strict";
  device.platform = "Portable Computing Language";
  EXPECT_EQ(cli::case_command(device, "coc", "1x1").find("defray validate --device 'llvmpipe"), 0u);
  device.platform = "rusticl";
  EXPECT_EQ(cli::case_command(device, "coc", "1x1").find("RUSTICL_ENABLE=llvmpipe defray validate"),
            0u);
  device.platform = "Oclgrind";
  EXPECT_EQ(cli::case_command(device, "coc", "1x1").find("oclgrind defray validate"), 0u);
}

}  // namespace
}  // namespace defray::test::validate_command_test
