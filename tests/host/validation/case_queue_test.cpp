// Cases prepared ahead of the device.
#include "validation/case_queue.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "base/error.h"
#include "support.h"

namespace defray::test::case_queue_test {
namespace {

using namespace defray::validation;

std::atomic<int> prepared = 0;

/// Takes longest for the first case; refuses a width of 7.
Outcome run_width(Backend&, const Case& c, const Input&) {
  if (c.width == 7) fail(ErrorKind::internal, "seven");
  if (c.width == 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ++prepared;
  return integers(std::vector<int>{c.width});
}

Exact exact_height(const Case& c, const Input&) { return {{{double(c.height)}}, 1}; }

double no_work(const Case&) { return 0; }

const KernelCheck check{"width", "equal", run_width, no_work, nullptr, exact_height};

std::vector<Case> cases_of(int count) {
  std::vector<Case> cases(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    cases[static_cast<std::size_t>(i)].width = i + 1;
    cases[static_cast<std::size_t>(i)].height = 3;
  }
  return cases;
}

TEST(CaseQueue, GivesCasesInTheirOrderWithTheirTwins) {
  for (const bool alone : {false, true}) {
    CaseQueue queue(check, cases_of(6), alone);
    for (int width = 1; width <= 6; ++width) {
      const PreparedCase next = queue.next();
      EXPECT_EQ(next.values.width, width);
      EXPECT_EQ(next.input.depth, make_input(next.values).depth);
      EXPECT_EQ(next.twin.integers, std::vector<std::int64_t>{width});
      ASSERT_TRUE(next.exact);
      EXPECT_EQ(next.exact->planes[0][0], 3);
    }
  }
}

TEST(CaseQueue, AnErrorComesWithItsCase) {
  CaseQueue queue(check, cases_of(8), false);
  for (int width = 1; width < 7; ++width) EXPECT_NO_THROW(queue.next()) << width;
  EXPECT_THROW(queue.next(), Error);
  EXPECT_EQ(queue.next().values.width, 8);
}

TEST(CaseQueue, MakesSomeAheadButAloneNone) {
  prepared = 0;
  CaseQueue alone(check, cases_of(3), true);
  alone.next();
  EXPECT_EQ(prepared, 1);
  const int count = 6;
  prepared = 0;
  {
    CaseQueue ahead(check, cases_of(count), false);
    ahead.next();
  }  // waits for those that are begun
  EXPECT_EQ(prepared, count);
}

}  // namespace
}  // namespace defray::test::case_queue_test
