// Twin of kernels/lens/coc.cl: the thin lens of Shinya 1994, eq. 2-3, in pinhole pixels.
#include <cmath>
#include <limits>

#include "reference/reference.h"
#include "reference/twin_backend.h"

namespace defray::reference {

double coc_px(const Lens& lens, int display_width_px, double depth_units) {
  // Seen from the object side: the cone from the aperture (diameter A) through the point at z
  // cuts the plane of focus z0 in a disc of diameter A |z - z0| / z; the pinhole picture shows a
  // length s on that plane as s F / z0 pixels, F its focal length in pixels.
  const double unit_mm = 1000 * lens.metres_per_unit;
  const double aperture = lens.aperture_diameter_mm / unit_mm;
  const double px_per_mm = lens.pixels_per_metre > 0 ? lens.pixels_per_metre / 1000
                                                     : display_width_px / lens.sensor_width_mm;
  const double pixel_focal = lens.focal_length_mm * px_per_mm;
  const double z0 = lens.focus_distance_units;
  const double z = depth_units;
  const bool is_background = !(z > 0) || std::isinf(z);
  if (z0 > std::numeric_limits<float>::max()) {
    return is_background ? 0 : -0.5 * aperture * pixel_focal / z;
  }
  // A textbook camera puts the sensor at the image distance f z0 / (z0 - f), not at f.
  const double f = lens.focal_length_mm / unit_mm;
  const double magnification =
      lens.model == LensModel::breathing ? pixel_focal / (z0 - f) : pixel_focal / z0;
  const double signed_share = is_background ? 1 : (z - z0) / z;
  return 0.5 * aperture * magnification * signed_share;
}

Quanta TwinBackend::coc(const Lens& lens, int display_width_px, const Values<float>& depth) {
  const double quantum = std::ldexp(1.0, -DEFRAY_COC_FRACTION_BITS);
  double limit = DEFRAY_COC_LIMIT_QUANTA * quantum;
  if (lens.max_coc_px > 0)
    limit = std::fmin(limit, std::round(lens.max_coc_px / quantum) * quantum);
  std::vector<std::int32_t> quanta(depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double r = coc_px(lens, display_width_px, static_cast<double>(depth[i]));
    const double limited = std::fmax(-limit, std::fmin(limit, r));
    quanta[i] = static_cast<std::int32_t>(std::nearbyint(limited / quantum));
  }
  return quanta;
}

}  // namespace defray::reference
