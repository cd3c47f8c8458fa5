#include "base/parallel.h"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>
#include <new>
#include <thread>

namespace defray {
namespace {

/// Threads that wait for work, one a core less the one that asks: to start them anew for each loop
/// takes longer than many a loop (40 µs each).
class Helpers {
 public:
  /// Never destroyed: a process may end at any time. A fork has none of the threads, and begins
  /// anew.
  static Helpers& instance() {
    alignas(Helpers) static std::byte room[sizeof(Helpers)];
    static Helpers* all = [] {
      pthread_atfork(nullptr, nullptr, [] { new (room) Helpers; });
      return new (room) Helpers;
    }();
    return *all;
  }

  void run(int most, const std::function<void()>& help, const std::function<void()>& own) {
    const auto job = [&] {
      const std::lock_guard lock(mutex_);
      start(most);
      most < started_ ? wake(most) : wanted_.notify_all();
      return jobs_.insert(jobs_.end(), Job{&help, most});
    }();
    own();
    std::unique_lock lock(mutex_);
    job->places = 0;  // none that has not begun by now
    done_.wait(lock, [&] { return job->at_work == 0; });
    jobs_.erase(job);
  }

 private:
  struct Job {
    const std::function<void()>* help;
    int places;  ///< For so many more.
    int at_work = 0;
  };

  /// As many as there will be use for.
  void start(int most) {
    for (; started_ < std::min(most, core_count() - 1); ++started_) {
      std::thread([this] { serve(); }).detach();
    }
  }

  void wake(int count) {
    for (int i = 0; i < count; ++i) wanted_.notify_one();
  }

  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto job =
          std::find_if(jobs_.begin(), jobs_.end(), [](const Job& j) { return j.places > 0; });
      if (job == jobs_.end()) {
        wanted_.wait(lock);
        continue;
      }
      --job->places;
      ++job->at_work;
      lock.unlock();
      (*job->help)();
      lock.lock();
      if (--job->at_work == 0) done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wanted_, done_;
  std::list<Job> jobs_;
  int started_ = 0;
};

}  // namespace

int core_count() {
  static const int count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return count;
}

void run_on_cores(int most, const std::function<void()>& help, const std::function<void()>& own) {
  const int helpers = std::min(most, core_count()) - 1;
  if (helpers > 0) {
    Helpers::instance().run(helpers, help, own);
  } else {
    own();
  }
}

}  // namespace defray
