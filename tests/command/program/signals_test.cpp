// What a signal leaves behind.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "command/forks.h"
#include "end_on_signals.h"
#include "support.h"

namespace defray::test::signals_test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The wait status of a process that gets a signal while it writes; its stderr goes to a file.
int interrupted_while_writing(const std::string& path, int signal, const std::string& err) {
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    cli::end_on_signals();
    write_safely(path, [&](const std::string& name) {
      std::ofstream(name) << "new";
      std::raise(signal);
    });
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

TEST(Signals, AnInterruptedWriteLeavesTheOldFileAlone) {
  const Folder folder, said;
  write_text(folder / "a.txt", "old");
  for (const int signal : {SIGINT, SIGTERM}) {
    const int status = interrupted_while_writing(folder / "a.txt", signal, said / "err");
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    std::vector<std::string> left;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      left.push_back(entry.path().filename().string());
    }
    EXPECT_EQ(left, std::vector<std::string>{"a.txt"});
    EXPECT_EQ(text_of(folder / "a.txt"), "old");
    EXPECT_EQ(text_of(said / "err"),
              std::string(signal == SIGINT ? "defray: interrupted" : "defray: terminated") +
                  ": finished files stay, no unfinished one is left\n");
  }
}

TEST(Forks, WhatHangsIsEndedAndSaysSo) {
  const Folder folder;
  const std::string file = folder / "err";
  const int status =
      run_in_fork({folder.path(), folder / "out", file, "help >/dev/null; sleep 60", "1"});
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(text_of(file), "ended: it took 1 s\n");
  // The next is none the worse for it.
  EXPECT_EQ(run_in_fork({folder.path(), folder / "out", file, "--version"}), 0);
}

}  // namespace
}  // namespace defray::test::signals_test
