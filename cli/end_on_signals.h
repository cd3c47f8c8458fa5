#pragma once
#include <unistd.h>

#include <csignal>
#include <string_view>

#include "image/safe_output.h"

namespace defray::cli {

/// On SIGINT and SIGTERM: removes the temporary file in hand, says so, then ends the process.
inline void end_on_signals() {
  const auto end = [](int signal) {
    remove_temporary();
    // Nothing but `write` is safe here; a progress bar has begun the line.
    const auto say = [](std::string_view text) {
      [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
    };
    if (isatty(STDERR_FILENO)) say("\n");
    say(signal == SIGINT ? "defray: interrupted" : "defray: terminated");
    say(": finished files stay, no unfinished one is left\n");
    _exit(128 + signal);
  };
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, end);
}

}  // namespace defray::cli
