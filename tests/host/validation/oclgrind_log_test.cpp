// What the simulator's log says: Oclgrind itself is not needed to write it.
#include "validation/oclgrind_log.h"

#include <cstdlib>
#include <fstream>

#include "support.h"

namespace defray::test::oclgrind_log_test {
namespace {

void append(const std::string& text) {
  std::ofstream(getenv("OCLGRIND_LOG"), std::ios::app | std::ios::binary) << text;
}

TEST(OclgrindLog, GivesWhatIsNewWithoutTheZerosBefore) {
  validation::OclgrindLog elsewhere(DeviceInfo{});
  EXPECT_EQ(elsewhere.take(), "");
  DeviceInfo simulator;
  simulator.platform = "Oclgrind";
  validation::OclgrindLog log(simulator);
  ASSERT_NE(getenv("OCLGRIND_LOG"), nullptr);
  EXPECT_EQ(log.take(), "");
  append("Invalid read of size 4");
  EXPECT_EQ(log.take(), "Invalid read of size 4");
  EXPECT_EQ(log.take(), "");
  append(std::string(100, '\0') + "Race on local memory");
  EXPECT_EQ(log.take(), "Race on local memory");
  append(std::string(5000, 'x'));
  EXPECT_EQ(log.take(), std::string(600, 'x'));
  EXPECT_EQ(log.take(), "");
  // Another context of the same process begins anew.
  append("before");
  validation::OclgrindLog next(simulator);
  append("after");
  EXPECT_EQ(next.take(), "after");
  for (const char* name : {"OCLGRIND_LOG", "OCLGRIND_DATA_RACES", "OCLGRIND_MAX_ERRORS"}) {
    unsetenv(name);
  }
}

}  // namespace
}  // namespace defray::test::oclgrind_log_test
