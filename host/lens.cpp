#include "lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"

namespace defray {
namespace {

constexpr double quanta_per_px = 1 << DEFRAY_COC_FRACTION_BITS;

void require_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    fail(ExitCode::usage, "{} is {}: it must be a finite number above 0", what, value);
  }
}

double focal_length_units(const Lens& lens) {
  return lens.focal_length_mm / 1000 / lens.metres_per_unit;
}

double aperture_units(const Lens& lens) {
  return lens.aperture_diameter_mm / 1000 / lens.metres_per_unit;
}

/// Beyond float range the kernel's focus distance would be infinite too: one answer for both.
bool is_focus_infinite(const Lens& lens) {
  return lens.focus_distance_units > std::numeric_limits<float>::max();
}

}  // namespace

void validate(const Lens& lens) {
  require_positive("focal length", lens.focal_length_mm);
  require_positive("sensor width", lens.sensor_width_mm);
  require_positive("scene unit", lens.metres_per_unit);
  if (!(lens.pixels_per_metre >= 0) || std::isinf(lens.pixels_per_metre)) {
    fail(ExitCode::usage, "--pixel-scale is {}: it must be a finite number above 0",
         lens.pixels_per_metre);
  }
  if (!(lens.aperture_diameter_mm >= 0) || !std::isfinite(lens.aperture_diameter_mm)) {
    fail(ExitCode::usage, "aperture diameter is {} mm: it must be 0 or more",
         lens.aperture_diameter_mm);
  }
  if (!(lens.max_coc_px >= 0)) {
    fail(ExitCode::usage, "--max-coc is {} px: it must be above 0", lens.max_coc_px);
  }
  if (!(lens.focus_distance_units > 0)) {
    fail(ExitCode::usage, "focus distance is {}: it must be above 0 (inf is allowed)",
         lens.focus_distance_units);
  }
  if (lens.focus_distance_units <= focal_length_units(lens)) {
    fail(ExitCode::usage,
         "focus distance {} lies inside the focal length ({} mm = {} scene units): focus farther "
         "away, or set --unit if depth is not in metres",
         lens.focus_distance_units, lens.focal_length_mm, focal_length_units(lens));
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
  DefrayCocParams p{};
  p.pixel_count = pixel_count;
  p.focus_is_infinite = is_focus_infinite(lens) ? 1 : 0;
  p.scale_quanta = static_cast<float>(quanta_per_px * background_coc_px(lens, display_width_px));
  if (is_focus_infinite(lens)) {
    p.infinite_focus_scale =
        static_cast<float>(quanta_per_px * infinite_focus_scale(lens, display_width_px));
  } else {
    p.focus_hi_units = static_cast<float>(z0);
    p.focus_lo_units = static_cast<float>(z0 - static_cast<double>(p.focus_hi_units));
  }
  p.limit_quanta = static_cast<float>(
      lens.max_coc_px > 0 ? std::min(std::round(lens.max_coc_px * quanta_per_px), limit) : limit);
  return p;
}

}  // namespace defray
