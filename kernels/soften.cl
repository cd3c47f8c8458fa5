// soften: each fragment's colour averaged over what one lens cell sees of its surface, so that few
// cells still count every pixel: a cell is 2 r / n pixels wide on the picture.
//
// Only fragments of nearly the same CoC count: their rays then land within half a cell of each
// other. The mean is taken of differences to the own colour: one colour stays that colour, and what
// is not finite stays as it is.
//
// coc_quanta   [height][layers][width]  signed radius, 1/256 px
// coverage     [height][layers][width]  2^-16 of the pixel; 0: no fragment. Bit 31 does not matter.
// channel0..3  [height][layers][width]
// out0..3      [height][layers][width]
// Global size: (width, height x layers).
#include "colour.clh"
#include "frame.clh"

__kernel void soften(const DefraySoftenParams p, __global const int* restrict coc_quanta,
                     __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                     WRITTEN_CHANNELS(out)) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.height * p.layers) return;
  const uint own_at = row * p.width + x;
  const float4 own = colour_at(CHANNELS(channel), own_at);
  const int own_coc = coc_quanta[own_at];
  const float side = fabs((float)own_coc) * (2.0f / 256.0f) / p.cells_a_side;
  set_colour(CHANNELS(out), own_at, own);
  if (side <= 1.0f || (coverage[own_at] & ~DEFRAY_SYNTHESISED) == 0u) return;

  const float half_side = 0.5f * side;
  const int reach = (int)(half_side + 0.5f);
  // Wide squares are sampled with a stride.
  const int stride = max(1, (2 * reach + DEFRAY_SOFTEN_TAPS) / DEFRAY_SOFTEN_TAPS);
  const int taps = min(reach / stride, DEFRAY_SOFTEN_TAPS / 2);
  const float alike = 128.0f * fmax(side, 1.0f);  // half a cell, in quanta
  const uint y = row / p.layers, layer = row % p.layers;
  float4 sum = 0.0f;
  float weights = 0.0f;
  for (int j = -taps; j <= taps; ++j) {
    for (int i = -taps; i <= taps; ++i) {
      const int2 d = stride * (int2)(i, j);
      const int2 at = (int2)((int)x, (int)y) + d;
      if (!is_inside(p.width, p.height, at)) continue;
      const uint q = ((uint)at.y * p.layers + layer) * p.width + (uint)at.x;
      if (fabs((float)coc_quanta[q] - (float)own_coc) > alike) continue;
      const float2 inside = clamp(half_side + 0.5f - convert_float2(abs(d)), 0.0f, 1.0f);
      const uint share = coverage[q] & ~DEFRAY_SYNTHESISED;
      const float weight = inside.x * inside.y * ((float)share * 0x1p-16f);
      if (!(weight > 0.0f)) continue;
      sum += weight * (colour_at(CHANNELS(channel), q) - own);
      weights += weight;
    }
  }
  const float4 difference = sum / weights;  // the fragment itself has weight
  const float4 changed = difference == 0.0f || !isfinite(own) ? own : own + difference;
  set_colour(CHANNELS(out), own_at, changed);  // -0 stays -0
}
