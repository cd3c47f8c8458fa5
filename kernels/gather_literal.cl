// gather_literal: the mean of the colours at Poisson-disk points within a pixel's own circle of
// confusion (Glatzel & Wilhelm, eq. 4 with the sum of their listing 3, over the CoC's radius).
//
// Colours are bilinear between pixel centres; outside the frame the nearest edge pixel counts. The
// mean is taken of differences to the pixel's own colour: one colour stays that colour bit for bit.
//
// coc_quanta   [height][width]     signed radius, 1/256 px; its sign does not matter here
// samples      [sample_count]      (x, y) in the unit disc
// rotations    [DEFRAY_GATHER_ROTATIONS]  (cos, sin)
// channel0..3  [height][width]
// out          [band_rows][width]
// Global size: (width, band_rows).
#include "frame.clh"
#include "gather.clh"

__kernel void gather_literal(const DefrayGatherParams p, __global const int* restrict coc_quanta,
                             __global const float2* restrict samples,
                             __global const float2* restrict rotations, CHANNEL_PARAMETERS(channel),
                             __global float4* restrict out) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;
  const uint y = p.band_y + row;
  const size_t target = (size_t)row * p.width + x;
  const size_t own_at = (size_t)y * p.width + x;
  const float4 own = colour_at(CHANNELS(channel), own_at);
  const float radius = fabs((float)coc_quanta[own_at]) * (1.0f / 256.0f) * p.radius_scale;
  const float2 turn = gather_turn(p, rotations, x, y);

  float4 sum = 0.0f;
  for (uint i = 0; i < p.sample_count && radius > 0.0f; ++i) {
    const float2 offset = radius * rotated(samples[i], turn);
    const int2 whole = whole_px(offset);
    const float2 part = offset - convert_float2(whole);  // exact: no digits are lost to a large x
    const int2 low = (int2)((int)x, (int)y) + whole;
    const int2 last = (int2)((int)p.width - 1, (int)p.height - 1);
    const int2 a = clamp(low, 0, last), b = clamp(low + 1, 0, last);
    const size_t top = (size_t)a.y * p.width, bottom = (size_t)b.y * p.width;
    const float4 c00 = colour_at(CHANNELS(channel), top + (uint)a.x);
    const float4 c10 = colour_at(CHANNELS(channel), top + (uint)b.x);
    const float4 c01 = colour_at(CHANNELS(channel), bottom + (uint)a.x);
    const float4 c11 = colour_at(CHANNELS(channel), bottom + (uint)b.x);
    const float4 upper = c00 + (c10 - c00) * part.x;
    const float4 lower = c01 + (c11 - c01) * part.x;
    sum += upper + (lower - upper) * part.y - own;
  }
  out[target] = radius > 0.0f ? own + sum / (float)p.sample_count : own;
}
