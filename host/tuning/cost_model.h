#pragma once
// What the qualities of the ray distribution buffer cost on a device, and which fits a budget.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chain/quality.h"
#include "tuning/device_file.h"

namespace defray::tuning {

/// Seconds for a million pixels: of all stages but rays, and of the rays through one lens point.
struct Cost {
  double fixed_s, point_s;
};

/// Costs by class of frames (tuning::frame_class) and quality. What was not measured is as on the
/// machine that defray was made on, by the ratio of what was.
class CostModel {
 public:
  double seconds(const std::string& frame_class, const Rung& rung, double megapixels) const;

  /// The best rung within the budget, the fastest where none is. After `last` it rises two rungs at
  /// a time, and stays where that is as near to the budget as times are known.
  std::size_t choose(const std::string& frame_class, double megapixels, double budget_s,
                     std::optional<std::size_t> last) const;

  /// What a rung took: half way from what was expected, within limits. `is_first`: of its quality
  /// in this process. Other qualities of the class come nearer to their ratio to this one: a cost
  /// that is wrong for once, and so never tried again, heals.
  void refine(const std::string& frame_class, const Rung& rung, double megapixels, double fixed_s,
              double rays_s, bool is_first);

  using Costs = std::map<std::pair<std::string, Quality>, Cost>;
  const Costs& costs() const { return costs_; }

  /// Takes a cost as it was kept. Throws Error(internal) for one that cannot be.
  void take(const std::string& frame_class, Quality quality, const Cost& cost);

 private:
  Cost cost(const std::string& frame_class, Quality quality) const;

  Costs costs_;
};

/// The model as a device's file keeps it, or an empty one with a reason in `notice`.
CostModel read_costs(const std::string& path, const Key& key, std::string& notice);

/// Writes it whole or not at all. Throws Error(output).
void write_costs(const std::string& path, const Key& key, const CostModel& model);

}  // namespace defray::tuning
