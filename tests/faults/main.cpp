// Runs the tests of faults alone: those of kernels are linked for the faults that stand beside
// them.
#include <gtest/gtest.h>

#include <string>

namespace {

bool is_of_faults(const testing::TestSuite& suite) {
  return std::string(suite.name()).find("Fault") != std::string::npos;
}

/// The filter that was given, without other suites.
std::string of_faults(std::string filter) {
  bool has_left_out = filter.find('-') != std::string::npos;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    if (is_of_faults(suite)) continue;
    filter += (has_left_out ? ":" : "-") + std::string(suite.name()) + ".*";
    has_left_out = true;
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  GTEST_FLAG_SET(filter, of_faults(GTEST_FLAG_GET(filter)));
  return RUN_ALL_TESTS();
}
