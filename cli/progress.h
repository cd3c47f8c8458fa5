#pragma once
// A progress bar on a terminal; nothing anywhere else.
#include <chrono>
#include <cstddef>
#include <string>

namespace defray::cli {

/// Counts frames (or one long job) and estimates the time left. Erases itself when it ends.
class ProgressBar {
 public:
  /// `what` is the unit, "frames". Silent unless standard error is a terminal and `enabled`.
  ProgressBar(std::size_t total, const char* what, bool enabled);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` whole items and `share` (0 to 1) of the next; `text` follows.
  void update(std::size_t done, double share, const std::string& text = "");
  /// Clears the line, so that other text can be printed.
  void clear();

 private:
  std::size_t total_;
  const char* what_;
  bool is_shown_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace defray::cli
