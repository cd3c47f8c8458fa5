#pragma once
// The best picture that a time allows.
#include <utility>

#include "defray/options.h"
#include "defray/report.h"
#include "library/backend_of.h"

namespace defray {

/// Throws Error(usage) for a budget that is none, and for methods that have no qualities.
void validate_budget(const MethodSettings& method, const ErrorSettings& error, double budget_ms);

/// A picture within a budget: its quality chosen before it is rendered, its time learnt after.
class Budget {
 public:
  /// Chooses by what is known of the device.
  Budget(Device& device, const std::string& frame_class, std::size_t pixels, double budget_ms);

  /// With the quality that was chosen.
  MethodSettings settings(MethodSettings method) const;

  const BudgetChoice& choice() const { return choice_; }

  /// Why what was known of the device is not used; empty where it is, or the second time.
  std::string take_notice() { return std::exchange(costs_.notice, ""); }

  /// What it took. Why that could not be kept for other runs, or empty.
  std::string learn(double seconds, const ChainReport& chain);

 private:
  Costs& costs_;
  std::string frame_class_;
  double megapixels_;
  BudgetChoice choice_;
};

}  // namespace defray
