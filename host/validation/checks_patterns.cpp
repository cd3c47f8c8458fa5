#include "validation/checks_patterns.h"

#include "chain/patterns/patterns_cells.h"
#include "device/device_backend.h"
#include "reference/reference.h"
#include "validation/patterns_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

Outcome run_difference(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, true);
  auto* const device = dynamic_cast<DeviceBackend*>(&backend);
  return integers(device ? device->patterns_difference(p.frame, p.pixels, p.shifts, p.settings)
                         : reference::patterns_difference(p.frame, p.pixels, p.shifts, p.settings));
}

/// With these variances, from twice that of random colours on, gains are well inside 0...1.
Outcome run_match(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  const std::size_t cells = size(pattern_units(c.width) * pattern_rows(c.height));
  Plane variance(cells * DEFRAY_PATTERN_UNIT);
  for (std::size_t i = 0; i < variance.size(); ++i) {
    variance[i] = 6 * 255 * 255 / 12.0f * static_cast<float>(1 + i % 7);
  }
  const Frame behind =
      backend.patterns(p.frame, p.behind, p.pixels, variance, p.shifts, p.settings);
  Outcome v;
  for (const auto& channel : behind.channels) v.planes.emplace_back(channel.begin(), channel.end());
  return v;
}

/// A weight is the sixth power of a quotient 5 u off, of another, 5 u off too, and a rounding: 72 u
/// with its products. It counts twice, above and below the line, times differences up to 2 L, and
/// once more in the gain.
double match_roundings(const Case&) { return 3 * 2 * 72 + 20; }

}  // namespace

std::vector<KernelCheck> patterns_checks() {
  return {{"patterns_difference", integer_rule, run_difference, difference_work},
          {"patterns_match", bits_rule, run_match, match_work, match_roundings}};
}

}  // namespace defray::validation
