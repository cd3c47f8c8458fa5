// 'defray validate' can fail: every fault put into a kernel must be found.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "fault.h"
#include "kernels/kernel_files.h"
#include "support.h"
#include "validation/oclgrind_log.h"
#include "validation/report.h"

namespace defray::test::faults_test {
namespace {

using namespace defray::validation;

// Compiling is most of the time: done quickly, and not again for each size of work-group.
constexpr const char* quick = "-cl-opt-disable";
constexpr int group = 64;

/// PoCL reads its built-in functions, nine megabytes of them, for the first of the contexts that
/// are alive: one is, from the first test to the last.
class OneContext : public testing::Environment {
  void SetUp() override { context_ = cl::Context(device_under_test().device); }
  void TearDown() override { context_ = cl::Context(); }
  cl::Context context_;
};

[[maybe_unused]] const auto* const one_context = testing::AddGlobalTestEnvironment(new OneContext);

/// The file that holds a kernel.
std::string file_of(const std::string& kernel) {
  for (const KernelFile& file : kernel_files) {
    if (std::string(file.text).find("__kernel void " + kernel + "(") != std::string::npos) {
      return file.name;
    }
  }
  throw std::runtime_error("no file holds the kernel " + kernel);
}

/// The files of all kernels that a check launches: a fault's program needs no others.
std::vector<std::string> files_of(const KernelCheck& check) {
  if (is_slow_device()) return {};
  static std::map<std::string, std::vector<std::string>> known;
  if (const auto found = known.find(check.name); found != known.end()) return found->second;
  SessionOptions options;
  options.measures = true;
  options.build_options = quick;
  options.use_int64_atomics = !check.needs_two_passes;
  Session session(device_under_test(), options);
  for (Case c : grid(Level::tiny, check, session.info().max_work_group)) {
    c.group_x = group;
    c.group_y = 1;
    run_case(session, check, c);
  }
  std::set<std::string> files;
  for (const auto& [kernel, seconds] : session.take_kernel_seconds()) {
    files.insert(file_of(kernel));
  }
  return known[check.name] = {files.begin(), files.end()};
}

/// The check with the change, or as it is, on a program of the files that it needs. `group_x`: of
/// all cases, empty: each its own.
KernelResult validate_with(const KernelCheck& check, const std::vector<Substitution>& changes,
                           std::optional<int> group_x, const std::string& only_case = "") {
  Settings settings;
  if (changes.empty()) settings.level = Level::tiny;  // all cases pass
  settings.only_case = only_case;
  settings.kernels = {check.name};
  settings.session.substitutions = changes;
  settings.session.files = files_of(check);
  settings.stops_at_first = true;
  settings.session.build_options = quick;
  settings.group_x = group_x;
  return validate_device(device_under_test(), settings).kernels.front();
}

/// What gave a fault away.
std::string finding(const KernelResult& result) {
  if (!result.error.empty()) return result.error;
  if (result.verdict.wrong > 0) {
    return fmt::format("{} of {} values beyond the rule at case {}: {}", result.verdict.wrong,
                       result.verdict.compared, result.cases, result.first_wrong);
  }
  return result.unstable > 0 ? "other bits in a second run" : "NOTHING";
}

void expect_found(const Fault& fault, const std::string& only_case = "") {
  const KernelCheck& check = find_check(fault.kernel);
  KernelResult result = validate_with(
      check, {fault.change}, is_slow_device() ? std::nullopt : std::optional(group), only_case);
  if (result.passed()) result = validate_with(check, {fault.change}, {}, only_case);
  testing::Test::RecordProperty("finding", finding(result));
  EXPECT_FALSE(result.passed()) << fault.kernel << ": " << fault.what;
  // Not for a reason of its own: a kernel that is not there fails as well.
  EXPECT_EQ(result.error.find("clCreateKernel"), std::string::npos) << result.error;
}

/// "rdb_merge: nothing shows through" as a test's name.
std::string as_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return text;
}

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, IsFound) { expect_found(GetParam()); }

std::vector<Fault> without_races() {
  std::vector<Fault> found;
  std::copy_if(all_faults().begin(), all_faults().end(), std::back_inserter(found),
               [](const Fault& fault) { return !fault.is_race; });
  return found;
}

INSTANTIATE_TEST_SUITE_P(Every, Faults, testing::ValuesIn(without_races()),
                         [](const testing::TestParamInfo<Fault>& fault) {
                           return as_name(
                               fmt::format("{}__{}", fault.param.kernel, fault.param.what));
                         });

TEST(NoFault, IsFoundByAnyCheckOnTheFilesThatItNeeds) {
  for (const KernelCheck& check : kernel_checks()) {
    const KernelResult result = validate_with(check, {}, group);
    EXPECT_TRUE(result.passed()) << check.name << ": " << finding(result);
  }
}

TEST(RaceFaults, RacesAreFoundOnTheSimulator) {
  if (!is_simulator(device_under_test())) GTEST_SKIP() << "needs Oclgrind: races show by chance";
  for (const Fault& fault : all_faults()) {
    if (fault.is_race) expect_found(fault);
  }
}

TEST(RaceFaults, RacesAreFoundAfterAThousandOthersOnTheSimulator) {
  if (!is_simulator(device_under_test())) GTEST_SKIP() << "needs Oclgrind: races show by chance";
  for (const Fault& fault : all_faults()) {
    if (fault.is_race) expect_found(fault, "37x11,converging,coc=1.7,cells=2,group=1x1,seed=31");
  }
}

TEST(FaultTable, HasAFaultForEveryCheck) {
  for (const KernelCheck& check : kernel_checks()) {
    const bool has_fault =
        std::any_of(all_faults().begin(), all_faults().end(),
                    [&](const Fault& fault) { return std::string(fault.kernel) == check.name; });
    EXPECT_TRUE(has_fault) << check.name;
  }
}

}  // namespace
}  // namespace defray::test::faults_test
