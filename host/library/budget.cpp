#include "library/budget.h"

#include <cmath>

#include "base/error.h"

namespace defray {

void validate_budget(const MethodSettings& method, const ErrorSettings& error, double budget_ms) {
  if (!(budget_ms > 0) || std::isinf(budget_ms)) {
    fail(ErrorKind::usage, "{} is {}: it must be a finite number of milliseconds above 0",
         field("budget_ms"), budget_ms);
  }
  if (method.method != Method::rdb || !method.chain) {
    fail(ErrorKind::usage, "{}: the ray distribution buffer with its stages alone has qualities",
         field("budget_ms"));
  }
  if (error.target_db) {
    fail(ErrorKind::usage, "{} and {}: one of them chooses the quality", field("budget_ms"),
         field("target_db"));
  }
}

Budget::Budget(Device& device, const std::string& frame_class, std::size_t pixels, double budget_ms)
    : costs_(costs_of(device)),
      frame_class_(frame_class),
      megapixels_(1e-6 * static_cast<double>(pixels)) {
  const auto known = costs_.last.find(frame_class);
  const auto last = known == costs_.last.end() ? std::nullopt : std::optional(known->second);
  const std::size_t rung = costs_.model.choose(frame_class, megapixels_, budget_ms / 1000, last);
  costs_.last[frame_class] = rung;
  const Rung& chosen = rungs()[rung];
  choice_ = {chosen.quality, chosen.cells_per_side,
             1000 * costs_.model.seconds(frame_class, chosen, megapixels_), budget_ms};
}

MethodSettings Budget::settings(MethodSettings method) const {
  method.chain = with_rung(*method.chain, {choice_.quality, choice_.cells_per_side});
  return method;
}

std::string Budget::learn(double seconds, const ChainReport& chain) {
  double rays = 0;
  for (const StageTime& stage : chain.stages) {
    if (stage.stage == std::string("rays")) rays += stage.seconds;
  }
  costs_.model.refine(frame_class_, {choice_.quality, choice_.cells_per_side}, megapixels_,
                      std::max(seconds - rays, 1e-6), std::max(rays, 1e-9),
                      costs_.used.insert(choice_.quality).second);
  if (costs_.path.empty()) return "";
  try {
    write_costs(costs_.path, costs_.key, costs_.model);
  } catch (const Error& error) {
    costs_.path.clear();  // said once
    return fmt::format("times are not kept for other runs: {}", error.what());
  }
  return "";
}

}  // namespace defray
