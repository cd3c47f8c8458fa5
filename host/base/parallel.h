#pragma once
// Loops over all cores.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace defray {

/// Calls task(i) for every i from 0 to count - 1, once, on every core, this thread included. Tasks
/// must not throw. `progress` gets the share done, 0 to 1, on this thread.
template <typename Task>
void parallel_for(int count, const Task& task, const std::function<void(double)>& progress = {}) {
  std::atomic<int> next = 0;
  const auto work = [&](bool reports) {
    for (int i = next++; i < count; i = next++) {
      task(i);
      if (reports && progress) progress(static_cast<double>(i + 1) / count);
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) {
    helpers.emplace_back(work, false);
  }
  work(true);
}

/// The same for a long row of short tasks: a stretch of them at a time.
template <typename Task>
void parallel_for_each(std::size_t count, const Task& task) {
  constexpr std::size_t stretch = 1 << 15;
  parallel_for(static_cast<int>((count + stretch - 1) / stretch), [&](int i) {
    const std::size_t first = static_cast<std::size_t>(i) * stretch;
    for (std::size_t k = first; k < std::min(first + stretch, count); ++k) task(k);
  });
}

}  // namespace defray
