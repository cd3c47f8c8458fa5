#include "options/curve.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace defray::cli {
namespace {

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // not from_chars'
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

Curve::Curve(const OptionText& option, const std::string& text) {
  const auto refuse = [&](const std::string& part, const char* why) {
    fail(ErrorKind::usage,
         "{}: '{}' {}; write a number like 2.5, without a unit ({}), or 3:1,2.2:24 for 3 at frame "
         "1 and 2.2 at frame 24 (with ,smooth at the end for a soft start and stop)",
         option.name, part, why, option.help);
  };
  std::vector<std::string> parts = split(text, ',');
  if (parts.size() > 1 && parts.back() == "smooth") {
    is_smooth_ = true;
    parts.pop_back();
  }
  for (const std::string& part : parts) {
    const std::size_t colon = part.find(':');
    const std::optional<double> value = number_in(part.substr(0, colon));
    if (!value) refuse(part, "cannot be read as a number");
    if (colon == part.npos && (parts.size() > 1 || is_smooth_)) refuse(part, "has no frame");
    double frame = 0;
    if (colon != part.npos) {
      has_frames_ = true;
      const std::optional<double> given = number_in(part.substr(colon + 1));
      if (!given || !std::isfinite(*given)) refuse(part, "has no frame number");
      if (!std::isfinite(*value)) refuse(part, "cannot be animated");
      frame = *given;
    }
    keys_.push_back({frame, *value});
  }
  if (keys_.empty()) refuse(text, "cannot be read as a number");
  std::stable_sort(keys_.begin(), keys_.end(),
                   [](const Key& a, const Key& b) { return a.frame < b.frame; });
  const auto same = std::adjacent_find(
      keys_.begin(), keys_.end(), [](const Key& a, const Key& b) { return a.frame == b.frame; });
  if (same != keys_.end()) refuse(text, "has a frame twice");
}

double Curve::at(double frame) const {
  if (frame <= keys_.front().frame) return keys_.front().value;
  if (frame >= keys_.back().frame) return keys_.back().value;
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), frame,
                                      [](double f, const Key& key) { return f < key.frame; });
  const auto before = after - 1;
  double t = (frame - before->frame) / (after->frame - before->frame);
  if (is_smooth_) t = t * t * (3 - 2 * t);
  return before->value + t * (after->value - before->value);
}

}  // namespace defray::cli
