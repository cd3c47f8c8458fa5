#pragma once
// Runs of the program in forks of a process that has loaded it, and done nothing else: loading its
// 270 shared libraries takes longer than most runs.
#include <string>

namespace defray::test {

/// Far more than any takes, with sanitizers and on a busy machine: what takes longer hangs, and is
/// ended with all that it has started, so that its test fails and others go on.
inline constexpr int most_seconds = 400;

struct Command {
  std::string folder;                                  ///< In which it runs.
  std::string out, err;                                ///< Files for what it prints.
  std::string arguments;                               ///< As for a shell.
  std::string seconds = std::to_string(most_seconds);  ///< It may take.
};

/// Must be called before anything makes a thread.
void start_forks();

/// `defray ARGUMENTS`: a status as of `waitpid`. Where the arguments need a shell (pipes,
/// redirections), or DEFRAY_TEST_EXEC is set, a shell runs the program itself.
int run_in_fork(const Command& command);

}  // namespace defray::test
