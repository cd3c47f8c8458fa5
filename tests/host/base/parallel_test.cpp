// Loops over all cores: every place once, whatever the length.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace defray::test::parallel_test {
namespace {

constexpr std::size_t lengths[] = {0, 1, 7, 32767, 32768, 32769, 100000};

TEST(Parallel, VisitsEveryPlaceOnce) {
  for (const std::size_t length : lengths) {
    std::vector<std::atomic<int>> visits(length);
    parallel_for_each(length, [&](std::size_t i) { ++visits[i]; });
    for (const auto& count : visits) ASSERT_EQ(count, 1) << length;
  }
}

TEST(Parallel, ThrowsWhatATaskThrowsAndOnlyThat) {
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> done = 0;
    EXPECT_THROW(parallel_for(1000,
                              [&](int i) {
                                if (i % 100 == 30) throw std::bad_alloc();
                                ++done;
                              }),
                 std::bad_alloc);
    EXPECT_LT(done, 1000);
  }
  EXPECT_NO_THROW(parallel_for(10, [](int) {}));
}

TEST(Parallel, CountsWhatIs) {
  for (const std::size_t length : lengths) {
    EXPECT_EQ(parallel_count(length, [](std::size_t i) { return i % 3 == 0; }), (length + 2) / 3);
    EXPECT_EQ(parallel_count(length, [](std::size_t) { return false; }), 0u);
  }
}

TEST(Parallel, FindsTheOnlyOneWhereverItIs) {
  for (const std::size_t length : lengths) {
    EXPECT_FALSE(parallel_any(length, [](std::size_t) { return false; }));
    for (const std::size_t place : {std::size_t{0}, length / 2, length - 1}) {
      if (length == 0) continue;
      EXPECT_TRUE(parallel_any(length, [&](std::size_t i) { return i == place; })) << length;
    }
  }
}

TEST(Parallel, LoopsWithinLoopsOnThreadsOfTheirOwnAllEnd) {
  std::atomic<int> visits = 0;
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 8; ++i) {
      callers.emplace_back([&] {
        for (int round = 0; round < 100; ++round) {
          parallel_for(5, [&](int) { parallel_for(7, [&](int) { ++visits; }); });
        }
      });
    }
  }
  EXPECT_EQ(visits, 8 * 100 * 5 * 7);
}

TEST(Parallel, AllCoresAreAtWorkAtOnce) {
  if (core_count() == 1) GTEST_SKIP() << "needs two cores";
  std::atomic<int> here = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  parallel_for(2, [&](int) {  // each waits for the other, which alone would come after it
    for (++here; here < 2 && std::chrono::steady_clock::now() < end;) std::this_thread::yield();
    EXPECT_EQ(here, 2);
  });
  EXPECT_EQ(here, 2);
}

/// A fork has none of the threads of its process.
TEST(Parallel, AForkGoesOnWithThreadsOfItsOwn) {
  parallel_for(100, [](int) {});
  EXPECT_EXIT(
      {
        std::atomic<int> visits = 0;
        for (int i = 0; i < 10; ++i) parallel_for(100, [&](int) { ++visits; });
        std::_Exit(visits == 1000 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace defray::test::parallel_test
