// Notes for every test of a program how long it took and what it reached.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "reached.h"

namespace defray::test {
namespace {

class Listener : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { clear_reached(); }
  void OnTestEnd(const testing::TestInfo& test) override {
    std::ofstream(std::string(std::getenv("DEFRAY_REACHED")) + "/TESTS", std::ios::app)
        << program_invocation_short_name << ' ' << test.test_suite_name() << '.' << test.name()
        << ' ' << test.result()->elapsed_time() << reached() << '\n';
  }
};

[[maybe_unused]] const bool listens = [] {
  if (std::getenv("DEFRAY_REACHED")) {
    testing::UnitTest::GetInstance()->listeners().Append(new Listener);
  }
  return true;
}();

}  // namespace
}  // namespace defray::test
