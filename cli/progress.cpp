#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace defray::cli {

ProgressBar::ProgressBar(std::size_t total, const char* what, bool enabled)
    : total_(std::max<std::size_t>(total, 1)),
      what_(what),
      is_shown_(enabled && isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (is_shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::update(std::size_t done, double share, const std::string& text) {
  if (!is_shown_) return;
  constexpr int bar_width = 30;
  const double part = (static_cast<double>(done) + share) / static_cast<double>(total_);
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const auto filled =
      static_cast<std::size_t>(std::clamp(static_cast<int>(part * bar_width), 0, bar_width));
  const int left = part > 0 ? static_cast<int>(std::ceil(elapsed / part - elapsed)) : 0;
  fmt::print(stderr, "\r[{}{}] {}/{} {}, {}:{:02} left{}{}\033[K", std::string(filled, '#'),
             std::string(bar_width - filled, '.'), done, total_, what_, left / 60, left % 60,
             text.empty() ? "" : "; ", text);
  std::fflush(stderr);
}

}  // namespace defray::cli
