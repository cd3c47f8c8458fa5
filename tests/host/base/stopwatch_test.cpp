// Laps follow each other: together they take no longer than all of it.
#include "base/stopwatch.h"

#include <chrono>
#include <thread>

#include "support.h"

namespace defray::test::stopwatch_test {
namespace {

TEST(Stopwatch, LapsAddUp) {
  const auto begin = std::chrono::steady_clock::now();
  Stopwatch watch;
  double laps = 0;
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const double lap = watch.lap();
    EXPECT_GE(lap, 0.005);
    laps += lap;
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(laps, all.count());
}

}  // namespace
}  // namespace defray::test::stopwatch_test
