#pragma once
#include <unistd.h>

#include <csignal>

#include "image/safe_output.h"

namespace defray::cli {

/// On SIGINT and SIGTERM: removes the temporary file in hand, then ends the process.
inline void end_on_signals() {
  const auto end = [](int signal) {
    remove_temporary();
    _exit(128 + signal);
  };
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, end);
}

}  // namespace defray::cli
