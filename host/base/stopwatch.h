#pragma once
// How long something took.
#include <chrono>

namespace defray {

/// Runs from its making on.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Seconds since the last lap, or the start; begins the next.
  double lap() {
    const double seconds = this->seconds();
    start_ = Clock::now();
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace defray
