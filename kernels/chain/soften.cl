// soften: each fragment's colour averaged over what one lens point sees of its surface, so that few
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
// Global size: (runs of DEFRAY_RUN fragments of a row, height x layers).
#include "base/colour.clh"
#include "base/run.clh"

// What a fragment averages: a square of so many taps around it.
typedef struct {
  float16 half_side;  // px
  float16 alike;      // largest difference in CoC, quanta
  int16 stride, taps;
  int16 is_active;  // the others keep their colour
} Squares;

Squares squares_of(const DefraySoftenParams p, const int16 own_coc, const int16 own_share) {
  const float16 side = fabs(convert_float16(own_coc)) * (2.0f / 256.0f) / p.cells_per_side;
  Squares s;
  s.half_side = 0.5f * side;
  const int16 reach = convert_int16(s.half_side + 0.5f);
  // Wide squares are sampled with a stride.
  s.stride = max((int16)(1), (2 * reach + DEFRAY_SOFTEN_TAPS) / DEFRAY_SOFTEN_TAPS);
  s.taps = reach / s.stride;                       // at most half of DEFRAY_SOFTEN_TAPS
  s.alike = 128.0f * fmax(side, (float16)(1.0f));  // half a cell, in quanta
  s.is_active = (side > 1.0f) & (own_share != 0);
  return s;
}

Places fragments_at(const DefraySoftenParams p, const int16 x, const int16 y, const int layer) {
  const int16 row = clamp(y, (int16)(0), (int16)((int)p.height - 1)) * (int)p.layers + layer;
  return places_at(p.width, clamp(x, (int16)(0), (int16)((int)p.width - 1)), row);
}

// Coverage without its flag.
int16 shares_at(__global const uint* restrict coverage, const Places from) {
  return ints_at((__global const int*)coverage, from) & (int)~DEFRAY_SYNTHESISED;
}

// How much of a pixel this far along x or y lies inside.
float16 inside(const float16 half_side, const int16 distance) {
  const float16 share = half_side + 0.5f - convert_float16(abs(distance));
  return clamp(share, (float16)(0.0f), (float16)(1.0f));
}

// Writes own colours with the mean difference to them added; where there is none, as they are.
void write_mean(__global float* out, const uint first, const int count, const float16 own,
                const float16 sum, const float16 weights, const int16 is_active) {
  const float16 difference = sum / weights;  // a fragment itself has weight
  const int16 stays = (difference == 0.0f) | ~isfinite(own) | ~is_active;  // -0 stays -0
  float lanes[RUN];
  vstore16(select(own + difference, own, stays), 0, lanes);
  for (int i = 0; i < count; ++i) out[first + (uint)i] = lanes[i];
}

__kernel void soften(const DefraySoftenParams p, __global const int* restrict coc_quanta,
                     __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                     WRITTEN_CHANNELS(out)) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height * p.layers, start)) return;
  const int16 x = (int16)(start.x) + RUN_LANES, y = (int16)(start.y / (int)p.layers);
  const int layer = start.y % (int)p.layers;
  const Places own_at = fragments_at(p, x, y, layer);
  const int16 own_coc = ints_at(coc_quanta, own_at);
  const Squares s = squares_of(p, own_coc, shares_at(coverage, own_at));
  const float16 own0 = floats_at(channel0, own_at), own1 = floats_at(channel1, own_at);
  const float16 own2 = floats_at(channel2, own_at), own3 = floats_at(channel3, own_at);
  float16 sum0 = 0.0f, sum1 = 0.0f, sum2 = 0.0f, sum3 = 0.0f, weights = 0.0f;
  const int most = any_lane(s.is_active) ? DEFRAY_SOFTEN_TAPS / 2 : -1;
  for (int j = -most; j <= most; ++j) {
    for (int i = -most; i <= most; ++i) {
      const int16 dx = s.stride * i, dy = s.stride * j;
      const int16 is_tap = s.is_active & (s.taps >= max(max(i, -i), max(j, -j)));
      if (!any_lane(is_tap)) continue;
      const int16 is_there =
          (x + dx >= 0) & (x + dx < (int)p.width) & (y + dy >= 0) & (y + dy < (int)p.height);
      const Places from = fragments_at(p, x + dx, y + dy, layer);
      const float16 apart =
          fabs(convert_float16(ints_at(coc_quanta, from)) - convert_float16(own_coc));
      const float16 share = convert_float16(shares_at(coverage, from)) * 0x1p-16f;
      const float16 weight = inside(s.half_side, dx) * inside(s.half_side, dy) * share;
      const int16 counts = is_tap & is_there & (apart <= s.alike) & (weight > 0.0f);
      if (!any_lane(counts)) continue;
      const float16 none = 0.0f;
      sum0 += select(none, weight * (floats_at(channel0, from) - own0), counts);
      sum1 += select(none, weight * (floats_at(channel1, from) - own1), counts);
      sum2 += select(none, weight * (floats_at(channel2, from) - own2), counts);
      sum3 += select(none, weight * (floats_at(channel3, from) - own3), counts);
      weights += select(none, weight, counts);
    }
  }
  const uint first = own_at.at.s0;
  const int count = run_length(p.width, start);
  write_mean(out0, first, count, own0, sum0, weights, s.is_active);
  write_mean(out1, first, count, own1, sum1, weights, s.is_active);
  write_mean(out2, first, count, own2, sum2, weights, s.is_active);
  write_mean(out3, first, count, own3, sum3, weights, s.is_active);
}
