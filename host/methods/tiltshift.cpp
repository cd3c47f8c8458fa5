#include "methods/tiltshift.h"

#include <algorithm>

#include "base/error.h"
#include "methods/linear.h"

namespace defray {

void validate(const TiltshiftSettings& s) {
  if (!(s.band_centre >= 0 && s.band_centre <= 1)) {
    fail(ErrorKind::usage, "{} is {}: allowed are 0 (top) to 1 (bottom of the frame)",
         field("band_centre"), s.band_centre);
  }
  if (!(s.band_width >= 0 && s.band_width <= 1)) {
    fail(ErrorKind::usage, "{} is {}: allowed are 0 to 1 frame heights", field("band_width"),
         s.band_width);
  }
  if (!(s.max_blur_px >= 0 && s.max_blur_px <= linear_max_radius_px)) {
    fail(ErrorKind::usage, "{} is {} px: allowed are 0 to {}", field("max_blur_px"), s.max_blur_px,
         linear_max_radius_px);
  }
}

DefrayTiltshiftParams tiltshift_params(const TiltshiftSettings& s, int width, int rows,
                                       int first_row, int display_height) {
  const double half_band = s.band_width / 2;
  const double ramp = std::max(s.band_centre, 1 - s.band_centre) - half_band;
  const double quanta = s.max_blur_px * (1 << DEFRAY_COC_FRACTION_BITS);
  DefrayTiltshiftParams p{};
  p.width = static_cast<std::uint32_t>(width);
  p.rows = static_cast<std::uint32_t>(rows);
  p.first_row_px = static_cast<float>(first_row);
  p.band_centre_px = static_cast<float>(s.band_centre * display_height);
  p.half_band_px = static_cast<float>(half_band * display_height);
  // A band as high as the frame leaves nothing to blur.
  p.limit_quanta = static_cast<float>(quanta);
  p.slope_quanta_per_px = ramp > 0 ? static_cast<float>(quanta / (ramp * display_height)) : 0;
  return p;
}

}  // namespace defray
