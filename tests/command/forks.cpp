#include "command/forks.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "command/program.h"
#include "run.h"

extern "C" void __gcov_dump() __attribute__((weak));

namespace defray::test {
namespace {

int requests = -1, answers = -1;  ///< Pipes to the process that forks, and back.

void redirect(const std::string& path, int flags, int to) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, to) < 0) _exit(127);
  close(file);
}

/// Runs last of what the program has registered for its end. The libraries' own ends would wait for
/// threads that no fork has.
void end_here(int status, void*) {
  std::fflush(nullptr);
  if (__gcov_dump) __gcov_dump();
  _exit(status);
}

[[noreturn]] void run_here(const Command& command) {
  setpgid(0, 0);
  alarm(static_cast<unsigned>(std::stoi(command.seconds)));
  if (chdir(command.folder.c_str()) != 0) _exit(127);
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(command.out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect(command.err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  const std::string line = program() + " " + command.arguments;
  wordexp_t words;
  if (std::getenv("DEFRAY_TEST_EXEC") ||
      wordexp(line.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) != 0) {
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  std::exit(cli::run(static_cast<int>(words.we_wordc), words.we_wordv));
}

/// A text with its length before it.
void send(int pipe, const std::string& text) {
  const std::size_t size = text.size();
  if (write(pipe, &size, sizeof size) != sizeof size ||
      write(pipe, text.data(), size) != static_cast<ssize_t>(size)) {
    throw std::runtime_error("a test's pipe is broken");
  }
}

/// False at the pipe's end.
bool receive(int pipe, std::string& text) {
  std::size_t size = 0;
  if (read(pipe, &size, sizeof size) != sizeof size) return false;
  text.resize(size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = read(pipe, text.data() + done, size - done);
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/// The OpenCL implementations, each with a compiler in it: loading them takes a fork longer than
/// what it is for. As OpenCL's loader finds them.
void load_implementations() {
  namespace fs = std::filesystem;
  const char* chosen = std::getenv("OCL_ICD_VENDORS");
  const fs::path vendors = chosen ? chosen : "/etc/OpenCL/vendors";
  std::vector<fs::path> files{vendors};
  if (fs::is_directory(vendors)) files.assign(fs::directory_iterator(vendors), {});
  for (const fs::path& file : files) {
    std::string library;
    if (file.extension() == ".icd" && std::getline(std::ifstream(file), library)) {
      dlopen(library.c_str(), RTLD_NOW);
    }
  }
}

[[noreturn]] void serve(int from, int to) {
  load_implementations();
  Command command;
  while (receive(from, command.folder) && receive(from, command.out) &&
         receive(from, command.err) && receive(from, command.arguments) &&
         receive(from, command.seconds)) {
    const pid_t child = fork();
    if (child == 0) {
      close(from);
      close(to);
      run_here(command);
    }
    int status = 127 << 8;
    if (child > 0) waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
      kill(-child, SIGKILL);
      std::ofstream(command.err, std::ios::app) << "ended: it took " << command.seconds << " s\n";
    }
    if (write(to, &status, sizeof status) != sizeof status) break;
  }
  _exit(0);
}

}  // namespace

void start_forks() {
  std::array<int, 2> there{}, back{};
  if (pipe2(there.data(), O_CLOEXEC) != 0 || pipe2(back.data(), O_CLOEXEC) != 0) std::abort();
  if (fork() == 0) {
    on_exit(end_here, nullptr);
    close(there[1]);
    close(back[0]);
    serve(there[0], back[1]);
  }
  close(there[0]);
  close(back[1]);
  requests = there[1];
  answers = back[0];
}

int run_in_fork(const Command& command) {
  for (const std::string& text :
       {command.folder, command.out, command.err, command.arguments, command.seconds}) {
    send(requests, text);
  }
  int status = 0;
  if (read(answers, &status, sizeof status) != sizeof status) {
    throw std::runtime_error("the process that forks has ended");
  }
  return status;
}

}  // namespace defray::test

int main(int argc, char** argv) {
  defray::test::start_forks();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
