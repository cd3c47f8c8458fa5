#pragma once
// What cases need beside the device, made ahead of it on the other cores.
#include <deque>
#include <future>
#include <optional>
#include <vector>

#include "validation/kernel_checks.h"

namespace defray::validation {

/// A case with what a kernel's result is held against.
struct PreparedCase {
  Case values;
  Input input;
  Outcome twin;
  std::optional<Exact> exact;  ///< Where the check has exact arithmetic.
};

PreparedCase prepare(const KernelCheck& check, const Case& c);

/// Cases in their order. The next ones are prepared while the device works on this one; not all, so
/// that few lie in memory. Alone: each when it is asked for.
class CaseQueue {
 public:
  CaseQueue(const KernelCheck& check, std::vector<Case> cases, bool alone);

  /// Of the case after the last one. Throws what its twin throws.
  PreparedCase next();

 private:
  void fill();

  const KernelCheck& check_;
  std::vector<Case> cases_;
  bool alone_;
  std::size_t begun_ = 0;
  std::deque<std::future<PreparedCase>> ahead_;
};

}  // namespace defray::validation
