// Which processes are at work.
#include "base/process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace defray::test::process_test {
namespace {

TEST(Process, RunsUntilItHasEndedThoughNobodyAsked) {
  EXPECT_TRUE(is_running(getpid()));
  EXPECT_FALSE(is_running(0));
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    char byte;
    close(ends[1]);
    const ssize_t count = read(ends[0], &byte, 1);  // until the other end is closed
    _exit(count == 0 ? 0 : 1);
  }
  close(ends[0]);
  EXPECT_TRUE(is_running(child));
  close(ends[1]);
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // it stays a zombie
  EXPECT_FALSE(is_running(child));
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(is_running(child));
}

}  // namespace
}  // namespace defray::test::process_test
