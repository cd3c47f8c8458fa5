#pragma once
// Other processes of this machine.
#include <signal.h>

#include <cerrno>

namespace defray {

/// Whether there is such a process, ours or not.
inline bool is_running(long pid) {
  return pid > 0 && (kill(static_cast<pid_t>(pid), 0) == 0 || errno != ESRCH);
}

}  // namespace defray
