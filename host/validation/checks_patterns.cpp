#include "validation/checks_patterns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "chain/pattern_window.h"
#include "device/device_stages.h"
#include "reference/reference.h"

namespace defray::validation {
namespace {

constexpr int shift_count = 4;

int window_of(const Case& c) { return std::array{25, 1, 2, 7}[c.seed % 4]; }

/// A frame of patterns made from a case's colours and radii.
class PatternCase {
 public:
  /// `hides_everything`: a fragment behind every pixel, so that all of a kernel's output counts.
  PatternCase(const Case& c, const Input& in, bool hides_everything)
      : frame(frame_of(c, in)), behind(frame.without_planes()) {
    std::vector<std::int32_t> coc = in.coc_quanta;
    std::reverse(coc.begin(), coc.end());
    behind.coc_quanta = std::move(coc);
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) add_pixel(Random(x, y, c.seed + 1), in, hides_everything);
    }
    frame.inverse = std::move(inverse_);
    behind.inverse = std::move(behind_inverse_);
    for (const Plane& plane : in.channels) {
      behind.channels.emplace_back(Plane(plane.rbegin(), plane.rend()));
    }
    settings.window_px = window_of(c);
    // Some pairs are of one surface, some are not.
    settings.tolerance_quanta = 256 + static_cast<std::int32_t>(128 * c.coc_px);
    add_shifts(c);
    pixels = pattern_pixels(std::move(encoded_), frame.channels, behind_);
  }

 private:
  void add_pixel(Random random, const Input& in, bool hides_everything) {
    const std::size_t i = encoded_.size();
    std::uint32_t word = random.next() < 0.8 ? DEFRAY_PATTERN_KNOWN : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float v = in.channels[std::min(k, in.channels.size() - 1)][i];
      word |= static_cast<std::uint32_t>(v > 0 ? 255 * std::min(v, 1.0f) : 0.0f) << (8 * k);
    }
    encoded_.push_back(word);
    inverse_.push_back(static_cast<float>(random.next()));
    behind_inverse_.push_back(static_cast<float>(random.next()));
    behind_.push_back(hides_everything || random.next() < 0.1);
  }

  /// Some lead out of the frame altogether.
  void add_shifts(const Case& c) {
    Random random(1, 2, c.seed);
    const auto any = [&](int extent) {
      const int most = std::min(extent, 40);
      return static_cast<int>(std::floor((2 * most + 1) * random.next())) - most;
    };
    for (int i = 0; i < shift_count; ++i) {
      const int x = any(c.width);
      shifts.push_back({x, any(c.height)});
    }
    // The first is what kernels by themselves are checked with.
    PatternShift& parallel = shifts[c.seed % 2];
    parallel.parallel = static_cast<float>(80 * random.next());
    (c.seed % 3 == 0 ? parallel.x : parallel.y) = 0;
  }

  std::vector<std::uint32_t> encoded_;
  std::vector<bool> behind_;
  Plane inverse_, behind_inverse_;

 public:
  Frame frame, behind;
  PatternSettings settings;
  std::vector<PatternShift> shifts;
  Words pixels;
};

template <typename T>
Outcome integers(const std::vector<T>& values) {
  return {{values.begin(), values.end()}, {}};
}

Outcome run_difference(Stages& stages, const Case& c, const Input& in) {
  const PatternCase p(c, in, true);
  auto* const device = dynamic_cast<DeviceStages*>(&stages);
  return integers(device
                      ? device->pattern_difference(p.frame, p.pixels, p.shifts[0], p.settings)
                      : reference::pattern_difference(p.frame, p.pixels, p.shifts[0], p.settings));
}

Outcome run_columns(Stages& stages, const Case& c, const Input& in) {
  const PatternCase p(c, in, true);
  auto* const device = dynamic_cast<DeviceStages*>(&stages);
  return integers(device ? device->pattern_columns(p.frame, p.pixels, p.shifts[0], p.settings)
                         : reference::pattern_columns(p.frame, p.pixels, p.shifts[0], p.settings));
}

/// Blended: one value from all sums of a pixel. With this variance gains are well inside 0...1.
Outcome run_match(Stages& stages, const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  const PatternSums sums = stages.patterns(p.frame, p.behind, p.pixels, p.shifts, p.settings);
  constexpr float variance = 6 * 255 * 255 / 12.0f;  // twice that of random colours
  Planes behind = p.behind.channels;
  blend_patterns(p.pixels, sums, Plane(p.pixels.size(), variance), behind);
  Outcome v;
  for (const auto& channel : behind) v.planes.emplace_back(channel.begin(), channel.end());
  return v;
}

std::size_t match_memory(const Case& c, const Input& in) {
  const PatternCase p(c, in, false);
  return pattern_band_bytes(c.width, PatternMargins(p.shifts, p.settings.window_px), c.band_rows);
}

double pixels_of(const Case& c) { return static_cast<double>(c.width) * c.height; }
double difference_work(const Case& c) { return pixels_of(c) * 4; }
double columns_work(const Case& c) { return pixels_of(c) * (4 + 2.0 * window_of(c)); }

double match_work(const Case& c) {
  return shift_count * (pixels_of(c) * (4 + 3.0 * window_of(c)) + band_work(c));
}

/// A weight is the sixth power of a quotient 5 u off, of another, 5 u off too, and a rounding: 72 u
/// with its products. It counts twice, above and below the line, times differences up to 2 L, and
/// once more in the gain.
double match_roundings(const Case&) { return 3 * 2 * 72 + 20; }

constexpr const char* integer_rule = "equal: integer arithmetic";
constexpr const char* bits_rule = "equal bits: + - x / in one order";

}  // namespace

std::vector<KernelCheck> pattern_checks() {
  return {
      {"patterns_columns", integer_rule, run_columns, columns_work},
      {"patterns_difference", integer_rule, run_difference, difference_work},
      {"patterns_match", bits_rule, run_match, match_work, match_roundings, nullptr, match_memory}};
}

}  // namespace defray::validation
