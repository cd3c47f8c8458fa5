#include "validation/checks_patterns.h"

#include "chain/patterns/patterns_cells.h"
#include "device/device_backend.h"
#include "opencl/bands.h"
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

constexpr int short_shift = 3;

/// The case's shifts as those of the picture, more of them, some longer than the frame; and short
/// ones, so that bands are no whole frames. Every row, second or third row.
Outcome run_agree(Backend& backend, const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  std::vector<DefrayPatternShift> far{{0, 0, 0, 0}, {c.width, 0, 0, 0}, {0, -c.height, 0, 0}};
  std::vector<DefrayPatternShift> near;
  for (const PatternShift& s : p.shifts) {
    far.push_back({s.x, s.y, 0, 0});
    far.push_back({-s.y / 2, s.x / 2, 0, 0});
    near.push_back({s.x, s.y % (short_shift + 1), 0, 0});
  }
  std::vector<std::uint64_t> sums;
  for (const auto& shifts : {far, near}) {
    for (const DefrayAgreement& a :
         backend.patterns_agree(p.frame, p.pixels, shifts, 1 + static_cast<int>(c.seed % 3),
                                p.settings.tolerance_quanta)) {
      sums.insert(sums.end(), {a.squares, a.pairs});
    }
  }
  return integers(sums);
}

std::size_t agree_memory(const Case& c, const Input& in) {
  return band_bytes("patterns_agree", frame_of(c, in), short_shift, c.band_rows);
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
  return {{"patterns_agree", integer_rule, run_agree, agree_work, nullptr, nullptr, agree_memory},
          {"patterns_difference", integer_rule, run_difference, difference_work},
          {"patterns_match", bits_rule, run_match, match_work, match_roundings}};
}

}  // namespace defray::validation
