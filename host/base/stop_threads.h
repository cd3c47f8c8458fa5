#pragma once

namespace defray {

/// Stops all threads but this one, for good, by calls that a signal handler may make: what it
/// tidies up before the process ends, they would fill again.
void stop_other_threads() noexcept;

/// Stops this one.
[[noreturn]] void stop_this_thread() noexcept;

}  // namespace defray
