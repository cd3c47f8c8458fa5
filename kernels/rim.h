// Cat's-eye vignetting: a second circle, the lens's rim, moves over the aperture as the pixel moves
// away from the frame's centre (host/cats_eye.h).
#ifndef DEFRAY_KERNELS_RIM_H
#define DEFRAY_KERNELS_RIM_H
#include "params.h"

// Whether light that goes through lens point u passes the rim, whose centre a pixel's column and
// row say; all in 2^-16 of the aperture radius.
bool passes_rim(const int2 u, const int rim_x, const int rim_y) {
  const long x = (long)u.x - rim_x, y = (long)u.y - rim_y;
  return x * x + y * y <= 1L << (2 * DEFRAY_LENS_FRACTION_BITS);
}

#endif
