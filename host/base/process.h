#pragma once
// Other processes of this machine.
#include <signal.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

namespace defray {

/// Whether a process has ended, and nobody has asked how.
inline bool is_zombie(long pid) {
  std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t name_end = text.rfind(')');  // "PID (NAME) STATE ..."
  return name_end != text.npos && text.compare(name_end, 3, ") Z") == 0;
}

/// Whether there is such a process at work, ours or not.
inline bool is_running(long pid) {
  const bool is_there = pid > 0 && (kill(static_cast<pid_t>(pid), 0) == 0 || errno != ESRCH);
  return is_there && !is_zombie(pid);
}

}  // namespace defray
