#pragma once
// What relaxed arithmetic buys and costs: the kernels built in other ways, against the strict ones.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "measure/html_report.h"
#include "validation/validation.h"

namespace defray::validation {

/// A way to build the kernels.
struct Variant {
  const char* name;
  const char* about;
  SessionOptions options;
};

/// "strict" first.
const std::vector<Variant>& variants();

/// A whole render against the strict one.
struct MethodFigures {
  std::string method;
  double psnr_db = 0;      ///< sRGB-encoded, clipped; infinity: equal.
  double worst = 0;        ///< Largest difference of a value, linear.
  double changed = 0;      ///< Share of values with other bits.
  bool is_stable = true;   ///< The same bits for every work-group and run.
  double time_ratio = 1;   ///< Median over rounds of this time / strict's in the same round.
  double time_spread = 0;  ///< Largest minus smallest ratio.
};

struct VariantResult {
  std::string name, about;
  std::string error;  ///< The device cannot build it; empty: it can.
  DeviceResult kernels;
  std::map<std::string, double> kernel_time_ratio;  ///< As time_ratio, of each kernel's own time.
  std::vector<MethodFigures> methods;
};

/// Renders the built-in fence at this size with every method and variant, in `rounds` rounds that
/// take the variants in turn, and runs the kernels' checks on the grid of this level. `progress`
/// gets the share done.
std::vector<VariantResult> measure_arithmetic(const DeviceInfo& info, int width, int height,
                                              int rounds, Level level = Level::quick,
                                              const std::function<void(double)>& progress = {});

/// Tables and plots of the trade. Pictures go to `folder`.
Section to_section(const std::vector<VariantResult>& results, const std::string& folder);

/// A JSON array, a variant an entry.
std::string to_json(const std::vector<VariantResult>& results);

}  // namespace defray::validation
