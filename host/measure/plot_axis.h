#pragma once
// An axis of a chart: its range and ticks.
#include <string>
#include <vector>

namespace defray {

class Axis {
 public:
  /// Spans `values` out to the next ticks. `name` is for messages. Throws Error(usage) on no
  /// values, non-finite ones (or beyond 1e100), and on a log axis those not above 0.
  Axis(const std::string& name, const std::vector<double>& values, bool is_log);

  /// Round numbers from one end of the axis to the other: 1, 2, 5 times powers of ten.
  const std::vector<double>& ticks() const { return ticks_; }

  /// 0 at the first tick, 1 at the last.
  double share(double value) const;

  /// A tick's number with as many digits as tell it from its neighbours.
  std::string label(double tick) const;

 private:
  bool is_log_;
  std::vector<double> ticks_;
};

}  // namespace defray
