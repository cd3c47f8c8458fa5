// linear_psf: every source pixel spread over its circle of confusion, whatever stands in the way
// (Potmesil & Chakravarty 1981; Shinya 1994, eq. 5: I = integral of h I0).
//
// The PSF h of radius r is the uniform disc with a border one pixel wide: a pixel whose centre lies
// d away gets clamp(r + 1/2 - d, 0, 1) / norm(r), norm(r) the sum of these over all pixels: a
// source's shares add up to 1. A gather over everything in reach, in one order: no atomics, the
// same bits on every device with correctly rounded square roots.
//
// row_reach   [window_rows]                 how far a source row's largest disc reaches, px
// radius_px   [window_rows][source_stride]  |CoC| of the source pixels, px
// channel0..3 the same                      colour / (2 norm(r)), so that r = 0 gives 1
// out0..3     [band_rows][width]
// Beyond the frame its first and last row repeat.
// Global size: (runs of DEFRAY_RUN pixels of a row, band_rows).
#include "base/colour.clh"
#include "base/run.clh"
#include "methods_params.h"

// Adds light where there is any: 0 * inf must not reach pixels that the disc does not.
float16 lit(const float16 weight, const float16 colour) {
  return select((float16)(-0.0f), weight * colour, weight > 0.0f);
}

__kernel void linear_psf(const DefrayLinearParams p, __global const int* restrict row_reach,
                         __global const float* restrict radius_px, CHANNEL_PARAMETERS(channel),
                         WRITTEN_CHANNELS(out)) {
  const int2 target = run_start();
  if (target.x >= (int)p.width || target.y >= (int)p.band_rows) return;
  const int y = target.y + (int)p.band_row;

  float16 sum0 = -0.0f, sum1 = -0.0f, sum2 = -0.0f, sum3 = -0.0f;  // -0 + c is c, for c = -0 too
  for (int dy = -p.reach; dy <= p.reach; ++dy) {
    const int source_row = clamp(y + dy, 0, (int)p.window_rows - 1);
    const int beyond = row_reach[source_row] + 1;  // no disc of this row reaches so far
    if (abs(dy) >= (uint)beyond) continue;
    const int half_chord = min((int)sqrt((float)(beyond * beyond - dy * dy)), beyond - 1);
    const size_t row = (size_t)source_row * p.source_stride + (uint)(target.x + p.reach);
    for (int dx = -half_chord; dx <= half_chord; ++dx) {
      const float distance = sqrt((float)(dx * dx + dy * dy));
      const size_t at = (size_t)((long)row + dx);
      const float16 radius = vload16(0, radius_px + at);
      const float16 weight = 2.0f * clamp(radius + 0.5f - distance, 0.0f, 1.0f);
      sum0 += lit(weight, vload16(0, channel0 + at));
      sum1 += lit(weight, vload16(0, channel1 + at));
      sum2 += lit(weight, vload16(0, channel2 + at));
      sum3 += lit(weight, vload16(0, channel3 + at));
    }
  }
  store_floats(p.width, out0, target, sum0);
  store_floats(p.width, out1, target, sum1);
  store_floats(p.width, out2, target, sum2);
  store_floats(p.width, out3, target, sum3);
}
