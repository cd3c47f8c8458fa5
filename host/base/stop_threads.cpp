#include "base/stop_threads.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <ctime>

#include "base/raw_folder.h"

namespace defray {
namespace {

/// Nobody else's: PoCL's LLVM handles most, and restores them when one comes.
constexpr int stopping = SIGURG;

void stay(int) { stop_this_thread(); }

}  // namespace

void stop_this_thread() noexcept {
  for (;;) pause();
}

void stop_other_threads() noexcept {
  struct sigaction action {};
  action.sa_handler = stay;
  sigfillset(&action.sa_mask);
  const int tasks = open("/proc/self/task", O_RDONLY | O_DIRECTORY);
  if (tasks < 0 || sigaction(stopping, &action, nullptr) != 0) return;
  const long own = syscall(SYS_gettid), process = getpid();
  for_each_name(tasks, [&](const char* name) {
    long thread = 0;
    for (; *name >= '0' && *name <= '9'; ++name) thread = 10 * thread + (*name - '0');
    if (thread > 0 && thread != own) syscall(SYS_tgkill, process, thread, stopping);
  });
  close(tasks);
  const timespec a_moment{0, 5000000};  // system calls under way come to their end
  nanosleep(&a_moment, nullptr);
}

}  // namespace defray
