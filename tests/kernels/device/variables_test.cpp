// No OpenCL call moves the environment variables that other threads may be asking for.
#include <unistd.h>

#include <cstdlib>

#include "opencl/device.h"
#include "opencl/kernel_cache.h"
#include "support.h"

namespace defray::test::variables_test {
namespace {

TEST(EnvironmentVariables, StayWhereTheyAreWhenDevicesAreFound) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process in which no OpenCL call was made
  EXPECT_EXIT(
      {
        unsetenv("HWLOC_PLUGINS_PATH");
        prepare_environment();
        char** const before = environ;
        const bool found = !list_devices().empty();
        _exit(found && environ == before ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace defray::test::variables_test
