#include "validation/case_queue.h"

#include <utility>

#include "base/parallel.h"
#include "reference/twin_backend.h"

namespace defray::validation {
namespace {

/// A case with much work must not keep the others waiting: on 2 cores 8 in work are a tenth faster
/// than 2.
constexpr std::size_t more_than_cores = 6;

}  // namespace

PreparedCase prepare(const KernelCheck& check, const Case& c) {
  PreparedCase prepared{c, make_input(c), {}, {}};
  reference::TwinBackend twins;
  prepared.twin = check.run(twins, c, prepared.input);
  if (check.exact) prepared.exact = check.exact(c, prepared.input);
  return prepared;
}

CaseQueue::CaseQueue(const KernelCheck& check, std::vector<Case> cases, bool alone)
    : check_(check), cases_(std::move(cases)), alone_(alone) {}

void CaseQueue::fill() {
  const std::size_t most = alone_ ? 1 : static_cast<std::size_t>(core_count()) + more_than_cores;
  while (ahead_.size() < most && begun_ < cases_.size()) {
    ahead_.push_back(std::async(alone_ ? std::launch::deferred : std::launch::async,
                                [this, i = begun_] { return prepare(check_, cases_[i]); }));
    ++begun_;
  }
}

PreparedCase CaseQueue::next() {
  fill();
  std::future<PreparedCase> first = std::move(ahead_.front());
  ahead_.pop_front();
  PreparedCase prepared = first.get();
  fill();
  return prepared;
}

}  // namespace defray::validation
