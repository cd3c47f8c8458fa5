#include "lens/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lens/coc.h"

namespace defray {
namespace {

/// Within these, no product of the lens's values leaves a double's range, and the focus distance
/// keeps all its digits in two floats.
constexpr double smallest = 1e-30, largest = 1e30;

bool is_usable(double value) { return value >= smallest && value <= largest; }

void require_positive(const std::string& what, double value) {
  if (!is_usable(value)) {
    fail(ErrorKind::usage, "{} is {}: it must be a number from {} to {}", what, value, smallest,
         largest);
  }
}

double focal_length_units(const Lens& lens) {
  return lens.focal_length_mm / 1000 / lens.metres_per_unit;
}

double aperture_units(const Lens& lens) {
  return lens.aperture_diameter_mm / 1000 / lens.metres_per_unit;
}

/// With a background CoC below this, focus might as well be at infinity: the radius changes by less
/// than half an ulp of half a quantum, from where on it rounds to more than 0. Above it, a quotient
/// that overflows in the kernel stands for a radius far beyond the limit.
constexpr double negligible_quanta = 0x1p-26;

/// A scale beyond float range is cut: what is not in focus passes the limit with it all the same
/// (the smallest share is 2^-53; with focus at infinity, depths beyond 1e29 units would not).
float as_float(double scale) {
  return static_cast<float>(
      std::min(scale, static_cast<double>(std::numeric_limits<float>::max())));
}

/// Beyond float range the kernel's focus distance would be infinite too: one answer for both.
bool is_focus_infinite(const Lens& lens) {
  return lens.focus_distance_units > std::numeric_limits<float>::max();
}

}  // namespace

void validate(const Lens& lens) {
  require_named("model", lens.model, LensModel::breathing);
  require_positive("focal length", lens.focal_length_mm);
  require_positive("sensor width", lens.sensor_width_mm);
  require_positive("scene unit", lens.metres_per_unit);
  if (lens.pixels_per_metre != 0)
    require_positive(field("pixels_per_metre"), lens.pixels_per_metre);
  if (lens.aperture_diameter_mm != 0 && !is_usable(lens.aperture_diameter_mm)) {
    fail(ErrorKind::usage, "aperture diameter is {} mm: it must be 0, or from {} to {}",
         lens.aperture_diameter_mm, smallest, largest);
  }
  if (!(lens.max_coc_px >= 0)) {
    fail(ErrorKind::usage, "{} is {} px: it must be above 0", field("max_coc_px"), lens.max_coc_px);
  }
  if (!(lens.focus_distance_units >= smallest)) {
    fail(ErrorKind::usage, "focus distance is {}: it must be {} or more (inf is allowed)",
         lens.focus_distance_units, smallest);
  }
  if (lens.focus_end_units != 0 && !(lens.focus_end_units >= lens.focus_distance_units)) {
    fail(ErrorKind::usage, "{} goes from {} to {}: it must not end before it begins",
         field("focus_range"), lens.focus_distance_units, lens.focus_end_units);
  }
  if (lens.focus_distance_units <= focal_length_units(lens)) {
    fail(ErrorKind::usage,
         "focus distance {} lies inside the focal length ({} mm = {} scene units): focus farther "
         "away, or set {} if depth is not in metres",
         lens.focus_distance_units, lens.focal_length_mm, focal_length_units(lens),
         field("metres_per_unit"));
  }
}

double pixel_focal_length(const Lens& lens, int display_width_px) {
  if (lens.pixels_per_metre > 0) return lens.focal_length_mm / 1000 * lens.pixels_per_metre;
  return display_width_px * lens.focal_length_mm / lens.sensor_width_mm;
}

double background_coc_px(const Lens& lens, int display_width_px) {
  const double z0 = lens.focus_distance_units;
  if (is_focus_infinite(lens)) return 0;
  const double distance = lens.model == LensModel::breathing ? z0 - focal_length_units(lens) : z0;
  return 0.5 * aperture_units(lens) * pixel_focal_length(lens, display_width_px) / distance;
}

double infinite_focus_scale(const Lens& lens, int display_width_px) {
  return 0.5 * aperture_units(lens) * pixel_focal_length(lens, display_width_px);
}

DefrayCocParams coc_params(const Lens& lens, int display_width_px, std::uint32_t pixel_count) {
  const double z0 = lens.focus_distance_units;
  const double limit = static_cast<double>(DEFRAY_COC_LIMIT_QUANTA);
  const double scale = quanta_per_px * background_coc_px(lens, display_width_px);
  DefrayCocParams p{};
  p.pixel_count = pixel_count;
  p.focus_is_infinite = scale < negligible_quanta ? 1 : 0;
  if (p.focus_is_infinite) {
    const bool is_infinite = is_focus_infinite(lens);  // else K z0: a breathing lens differs
    p.infinite_focus_scale = as_float(
        is_infinite ? quanta_per_px * infinite_focus_scale(lens, display_width_px) : scale * z0);
  } else {
    p.scale_quanta = as_float(scale);
    p.focus_hi_units = static_cast<float>(z0);
    p.focus_lo_units = static_cast<float>(z0 - static_cast<double>(p.focus_hi_units));
  }
  p.limit_quanta = static_cast<float>(
      lens.max_coc_px > 0 ? std::min(std::round(lens.max_coc_px * quanta_per_px), limit) : limit);
  return p;
}

}  // namespace defray
