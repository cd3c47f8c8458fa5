// 'defray validate' can fail: every fault put into a kernel must be found.
#include "faults.h"

#include <iostream>

#include "support.h"
#include "validation/oclgrind_log.h"
#include "validation/report.h"

namespace defray::test {
namespace {

using namespace defray::validation;

KernelResult validate_with(const Fault& fault, const std::string& only_case) {
  Settings settings;
  settings.only_case = only_case;
  settings.kernels = {fault.kernel};
  settings.session.substitutions = {fault.change};
  settings.stops_at_first = true;
  settings.session.build_options = "-cl-opt-disable";  // compiling is most of the time
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
  const KernelResult result = validate_with(fault, only_case);
  std::cout << fmt::format("{:22} {:44} {}\n", fault.kernel, fault.what, finding(result));
  EXPECT_FALSE(result.passed()) << fault.kernel << ": " << fault.what;
}

TEST(Faults, EveryFaultIsFoundByItsKernelsCheck) {
  for (const Fault& fault : faults()) {
    if (!fault.is_race) expect_found(fault);
  }
}

TEST(Faults, RacesAreFoundOnTheSimulator) {
  if (!is_simulator(device_under_test())) GTEST_SKIP() << "needs Oclgrind: races show by chance";
  for (const Fault& fault : faults()) {
    if (fault.is_race) expect_found(fault);
  }
}

TEST(Faults, RacesAreFoundAfterAThousandOthersOnTheSimulator) {
  if (!is_simulator(device_under_test())) GTEST_SKIP() << "needs Oclgrind: races show by chance";
  for (const Fault& fault : faults()) {
    if (fault.is_race) expect_found(fault, "37x11,converging,coc=1.7,cells=2,group=1x1,seed=31");
  }
}

TEST(Faults, ThereIsOneForEveryCheck) {
  for (const KernelCheck& check : kernel_checks()) {
    const bool has_fault = std::any_of(faults().begin(), faults().end(), [&](const Fault& fault) {
      return std::string(fault.kernel) == check.name;
    });
    EXPECT_TRUE(has_fault) << check.name;
  }
}

}  // namespace
}  // namespace defray::test
