// gather_literal: the mean of the colours at Poisson-disk points within a pixel's own circle of
// confusion (Glatzel & Wilhelm, eq. 4 with the sum of their listing 3, over the CoC's radius).
//
// Colours are bilinear between pixel centres; outside the frame the nearest edge pixel counts. The
// mean is taken of differences to the pixel's own colour: one colour stays that colour bit for bit.
//
// coc_quanta   [window_rows][width]  signed radius, 1/256 px; its sign does not matter here
// samples      [sample_count]        (x, y) in the unit disc
// rotations    [DEFRAY_GATHER_ROTATIONS]  (cos, sin)
// colour       [window_rows][width]  four channels
// out          [band_rows][width]    likewise
// Global size: (runs of DEFRAY_RUN pixels of a row, band_rows).
#include "methods/gather.clh"

// Whole pixels at or below places of less than 2^31. (Of floor PoCL makes a call.)
int16 whole_px(const float16 places) {
  const int16 towards_zero = convert_int16(places);
  return select(towards_zero, towards_zero - 1, convert_float16(towards_zero) > places);
}

// The colour `part` of a pixel beyond `low`, bilinear.
float4 colour_between(const DefrayGatherParams p, __global const float4* restrict colour,
                      const int2 low, const float2 part) {
  const int2 last = (int2)((int)p.width - 1, (int)p.window_rows - 1);
  const int2 a = clamp(low, 0, last), b = clamp(low + 1, 0, last);
  const size_t top = (size_t)a.y * p.width, bottom = (size_t)b.y * p.width;
  const float4 c00 = colour[top + (uint)a.x], c10 = colour[top + (uint)b.x];
  const float4 c01 = colour[bottom + (uint)a.x], c11 = colour[bottom + (uint)b.x];
  const float4 upper = c00 + (c10 - c00) * part.x;
  const float4 lower = c01 + (c11 - c01) * part.x;
  return upper + (lower - upper) * part.y;
}

__kernel void gather_literal(const DefrayGatherParams p, __global const int* restrict coc_quanta,
                             __global const float2* restrict samples,
                             __global const float2* restrict rotations,
                             __global const float4* restrict colour,
                             __global float4* restrict out) {
  const GatherRun run = gather_run(p);
  if (run.count <= 0) return;
  const float16 radii = fabs(gather_radii(p, coc_quanta, run));
  const RunVectors turn = gather_turns(p, rotations, run);

  float radius[RUN];
  vstore16(radii, 0, radius);
  float4 sum[RUN];
  for (int i = 0; i < RUN; ++i) sum[i] = 0.0f;
  for (uint k = 0; k < p.sample_count; ++k) {
    const RunVectors offset = offsets_of(samples[k], turn, radii);
    const int16 whole_x = whole_px(offset.x), whole_y = whole_px(offset.y);
    // Exact: no digits are lost to a large x.
    const float16 part_x = offset.x - convert_float16(whole_x);
    const float16 part_y = offset.y - convert_float16(whole_y);
    int low_x[RUN], low_y[RUN];
    float along_x[RUN], along_y[RUN];
    vstore16((int)run.x + RUN_LANES + whole_x, 0, low_x);
    vstore16((int)run.row + whole_y, 0, low_y);
    vstore16(part_x, 0, along_x);
    vstore16(part_y, 0, along_y);
    for (int i = 0; i < run.count; ++i) {
      if (!(radius[i] > 0.0f)) continue;
      const float4 there =
          colour_between(p, colour, (int2)(low_x[i], low_y[i]), (float2)(along_x[i], along_y[i]));
      sum[i] += there - colour[run.first + (size_t)i];
    }
  }
  for (int i = 0; i < run.count; ++i) {
    const float4 own = colour[run.first + (size_t)i];
    out[run.target + (size_t)i] = radius[i] > 0.0f ? own + sum[i] / (float)p.sample_count : own;
  }
}
