// tiltshift: the CoC of a photographer's fake miniature, from a pixel's row alone: none in a
// horizontal band, growing linearly away from it (Glatzel & Wilhelm, figure 2: the reflected linear
// gradient that steers a lens blur). `linear_psf` then blurs.
//
// coc_quanta  [rows][width]  radius, 1/256 px, rounded to nearest even
// Global size: (width, rows).
#include "methods_params.h"

__kernel void tiltshift(const DefrayTiltshiftParams p, __global int* restrict coc_quanta) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.rows) return;
  const float centre = p.first_row_px + (float)row + 0.5f;
  const float beyond = fmax(fabs(centre - p.band_centre_px) - p.half_band_px, 0.0f);
  coc_quanta[(size_t)row * p.width + x] =
      convert_int_rte(fmin(p.slope_quanta_per_px * beyond, p.limit_quanta));
}
