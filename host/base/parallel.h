#pragma once
// Loops over all cores.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace defray {

/// Of this machine that the process may use; at least 1.
int core_count();

/// Calls `own` here and meanwhile `help` on up to `most` - 1 other cores, once on each that is free
/// before `own` is done. Neither may throw.
void run_on_cores(int most, const std::function<void()>& help, const std::function<void()>& own);

/// Calls task(i) for every i from 0 to count - 1, once, on every core, this thread included. What a
/// task throws, no memory for one, is thrown here, once those at work are done. `progress` gets the
/// share done, 0 to 1, on this thread.
template <typename Task>
void parallel_for(int count, const Task& task, const std::function<void(double)>& progress = {}) {
  std::atomic<int> next = 0;
  std::exception_ptr thrown;
  std::once_flag first;
  const auto work = [&](bool reports) {
    try {
      for (int i = next++; i < count; i = next++) {
        task(i);
        if (reports && progress) progress(static_cast<double>(i + 1) / count);
      }
    } catch (...) {
      std::call_once(first, [&] { thrown = std::current_exception(); });
      next = count;
    }
  };
  run_on_cores(
      count, [&] { work(false); }, [&] { work(true); });
  if (thrown) std::rethrow_exception(thrown);
}

/// A long row is cut into stretches of this length.
inline constexpr std::size_t stretch_length = 1 << 15;
/// The same where the cut changes no bit: short enough that all cores have some of a short row.
inline constexpr std::size_t short_stretch = 1 << 12;

/// Calls task(first, end) for stretches of a long row, each once.
template <typename Task>
void parallel_for_stretches(std::size_t count, const Task& task,
                            std::size_t length = stretch_length) {
  parallel_for(static_cast<int>((count + length - 1) / length), [&](int i) {
    const std::size_t first = static_cast<std::size_t>(i) * length;
    task(first, std::min(first + length, count));
  });
}

/// As parallel_for for a long row of short tasks.
template <typename Task>
void parallel_for_each(std::size_t count, const Task& task) {
  parallel_for_stretches(
      count,
      [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k) task(k);
      },
      short_stretch);
}

/// The sum of `sum_of(first, end)` over stretches of a long row: added in their order, so that
/// every machine's rounding is the same.
template <typename SumOf>
auto parallel_sum(std::size_t count, const SumOf& sum_of) {
  std::vector<decltype(sum_of(count, count))> parts((count + stretch_length - 1) / stretch_length);
  parallel_for_stretches(count, [&](std::size_t first, std::size_t end) {
    parts[first / stretch_length] = sum_of(first, end);
  });
  decltype(sum_of(count, count)) all{};
  for (const auto& part : parts) all += part;
  return all;
}

/// For how many i below count `is(i)`.
template <typename Is>
std::size_t parallel_count(std::size_t count, const Is& is) {
  std::atomic<std::size_t> all = 0;
  parallel_for_stretches(
      count,
      [&](std::size_t first, std::size_t end) {
        std::size_t found = 0;
        for (std::size_t k = first; k < end; ++k) found += is(k) ? 1 : 0;
        all += found;
      },
      short_stretch);
  return all;
}

/// Whether `is(i)` for any i below count: not all are asked once one is found.
template <typename Is>
bool parallel_any(std::size_t count, const Is& is) {
  std::atomic<bool> found = false;
  parallel_for_each(count, [&](std::size_t i) {
    if (!found.load(std::memory_order_relaxed) && is(i)) found = true;
  });
  return found;
}

}  // namespace defray
