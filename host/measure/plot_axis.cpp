#include "measure/plot_axis.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace defray {
namespace {

constexpr double largest_value = 1e100;

void validate(const std::string& name, const std::vector<double>& values, bool is_log) {
  if (values.empty()) fail(ErrorKind::usage, "the chart has no points to draw");
  for (const double value : values) {
    if (!(std::fabs(value) <= largest_value)) {
      fail(ErrorKind::usage, "chart axis '{}': {} cannot be drawn (finite numbers up to {:g} can)",
           name, value, largest_value);
    }
    if (is_log && !(value >= 1 / largest_value)) {
      fail(ErrorKind::usage, "chart axis '{}' is logarithmic: {} cannot be drawn, only numbers > 0",
           name, value);
    }
  }
}

/// 1, 2 or 5 times a power of ten, at least `length`.
double round_step(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= length * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<double> linear_ticks(double low, double high) {
  const double magnitude = std::max(std::fabs(low), std::fabs(high));
  if (high - low <= 1e-9 * magnitude || magnitude == 0) {  // one value: give it some room
    const double room = magnitude > 0 ? magnitude / 2 : 1;
    return linear_ticks(low - room, high + room);
  }
  const double step = round_step((high - low) / 8);
  // The slack keeps a value that is a tick but for rounding from asking for one tick more.
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> ticks;
  for (double i = first; i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

std::vector<double> log_ticks(double low, double high) {
  if (high <= low * (1 + 1e-9)) return log_ticks(low / 2, high * 2);
  const double decades = std::log10(high / low);
  const int stride = static_cast<int>(std::ceil(decades / 10));
  const std::vector<double> factors =
      decades > 3 ? std::vector<double>{1} : std::vector<double>{1, 2, 5};
  std::vector<double> ticks;
  for (int e = static_cast<int>(std::floor(std::log10(low) / stride) - 1) * stride;; e += stride) {
    for (const double factor : factors) {
      const double tick = factor * std::pow(10, e);
      if (tick <= low * (1 + 1e-9)) ticks.clear();  // starts with the last one below the data
      ticks.push_back(tick);
      if (tick >= high * (1 - 1e-9)) return ticks;
    }
  }
}

}  // namespace

Axis::Axis(const std::string& name, const std::vector<double>& values, bool is_log)
    : is_log_(is_log) {
  validate(name, values, is_log);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  ticks_ = is_log ? log_ticks(*low, *high) : linear_ticks(*low, *high);
}

double Axis::share(double value) const {
  const double low = ticks_.front(), high = ticks_.back();
  if (is_log_) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

std::string Axis::label(double tick) const {
  if (is_log_) return fmt::format("{:g}", tick);
  const double step = ticks_[1] - ticks_[0];
  const double magnitude = std::max(std::fabs(ticks_.front()), std::fabs(ticks_.back()));
  const int digits = std::max(1, 1 + static_cast<int>(std::ceil(std::log10(magnitude / step))));
  // Digits count from the largest tick; a smaller one has fewer before the point.
  const double rounded = std::round(tick / step) * step;
  return fmt::format("{:.{}g}", rounded == 0 ? 0 : rounded, std::max(digits, 5));
}

}  // namespace defray
