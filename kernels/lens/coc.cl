// coc: planar depth -> signed radius of the circle of confusion, quantised once.
//
// coc = K (z - z0) / z, negative in front of the plane of focus (Potmesil & Chakravarty 1981;
// Shinya 1994, eq. 2-3, in pinhole pixels). The difference is taken first: the algebraically equal
// K (1 - z0/z) loses every digit near focus.
//
// Every value has an answer, and no NaN reaches the rounding: what is no finite depth (inf, NaN, 0,
// negative) is background. A difference or quotient that overflows stands for a radius far beyond
// the limit (host/lens/lens.cpp sees to it), and becomes the limit.
//
// depth_units  [pixel_count]  planar depth > 0, scene units; anything else is background
// coc_quanta   [pixel_count]  signed radius, 1/256 px, rounded to nearest even
// Global size: pixel_count, or more.
#include "params.h"

// By its bits: devices that take denormals for 0 still see them as depths in front of everything.
bool is_finite_depth(const float z) { return as_uint(z) - 1u < 0x7f7fffffu; }

__kernel void coc(const DefrayCocParams p, __global const float* restrict depth_units,
                  __global int* restrict coc_quanta) {
  const uint i = get_global_id(0);
  if (i >= p.pixel_count) return;
  const float z = depth_units[i];
  float radius;
  if (p.scale_quanta == 0.0f && p.infinite_focus_scale == 0.0f) {
    radius = 0.0f;  // a closed aperture; 0 * inf below would be NaN
  } else if (!is_finite_depth(z)) {
    radius = p.focus_is_infinite ? 0.0f : p.scale_quanta;  // the limit; inf / inf is NaN
  } else if (p.focus_is_infinite) {
    radius = -p.infinite_focus_scale / z;
  } else {
    const float from_focus = (z - p.focus_hi_units) - p.focus_lo_units;
    radius = p.scale_quanta * (from_focus / z);
  }
  coc_quanta[i] = convert_int_rte(clamp(radius, -p.limit_quanta, p.limit_quanta));
}
