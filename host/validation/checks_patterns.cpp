#include "validation/checks_patterns.h"

#include "chain/patterns_window.h"
#include "device/device_backend.h"
#include "reference/reference.h"
#include "validation/patterns_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

Outcome run_difference(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, true);
  auto* const device = dynamic_cast<DeviceBackend*>(&backend);
  return integers(device
                      ? device->patterns_difference(p.frame, p.pixels, p.shifts[0], p.settings)
                      : reference::patterns_difference(p.frame, p.pixels, p.shifts[0], p.settings));
}

Outcome run_columns(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, true);
  auto* const device = dynamic_cast<DeviceBackend*>(&backend);
  return integers(device ? device->patterns_columns(p.frame, p.pixels, p.shifts[0], p.settings)
                         : reference::patterns_columns(p.frame, p.pixels, p.shifts[0], p.settings));
}

/// Blended: one value from all sums of a pixel. With this variance gains are well inside 0...1.
Outcome run_match(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  const PatternSums sums = backend.patterns(p.frame, p.behind, p.pixels, p.shifts, p.settings);
  constexpr float variance = 6 * 255 * 255 / 12.0f;  // twice that of random colours
  Planes behind = p.behind.channels;
  blend_patterns(p.pixels, sums, Plane(p.pixels.size(), variance), behind);
  Outcome v;
  for (const auto& channel : behind) v.planes.emplace_back(channel.begin(), channel.end());
  return v;
}

std::size_t match_memory(const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  return patterns_band_bytes(c.width, PatternMargins(p.shifts, p.settings.window_px), c.band_rows);
}

/// A weight is the sixth power of a quotient 5 u off, of another, 5 u off too, and a rounding: 72 u
/// with its products. It counts twice, above and below the line, times differences up to 2 L, and
/// once more in the gain.
double match_roundings(const Case&) { return 3 * 2 * 72 + 20; }

}  // namespace

std::vector<KernelCheck> patterns_checks() {
  return {
      {"patterns_columns", integer_rule, run_columns, columns_work},
      {"patterns_difference", integer_rule, run_difference, difference_work},
      {"patterns_match", bits_rule, run_match, match_work, match_roundings, nullptr, match_memory}};
}

}  // namespace defray::validation
