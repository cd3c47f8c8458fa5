// patterns: what a shift of the whole picture says about hidden pixels.
//
// Periodic and repeating surfaces look alike at a few shifts (He & Sun 2012, "Statistics of patch
// offsets for image completion"). For one shift s: how well the surroundings of a pixel x agree
// with those of x + s, and, the better the more weight, the colour of x + s for what x hides.
// Where a floor or a wall slants, its pattern repeats at one distance in the scene: then s is
// parallel to the picture there, and as long in it as the surface is near.
//
// patterns_difference   squared difference of the 8-bit colours of x and x + s, where both are
//                       known and of one surface (similar CoC)
// patterns_columns      its sums over columns with weights n - |dy|: a box of n rows, twice
// patterns_match        the same along rows; D, the mean squared difference; then weight
//                       w = (1/100 / D)^6, D in units of white squared, and the sums of w, w D and
//                       w (colour of x + s - smooth colour behind x)
//
// Differences and their sums are integers: exact, whatever the order, so that sums may run along.
// All planes but the colours are windows of [window rows][stride] (DefrayPatternParams).
//
// pixels       8-bit colour, known and behind flags (params.h)
// coc_quanta   signed radius, 1/256 px
// inverse      1/depth
// difference   bit 24: a pair; below: its squared difference
// sums         number of pairs << 40 | squared differences, weighted
// behind_coc   [rows][width]                  radius of the synthesised fragment
// behind_inverse [rows][width]                its 1/depth
// channel_behind0..3  [rows][width]          its colour, before: smooth
// channel0..3  [from source_row rows above the band on][width]   linear colours of the frame
// sum          [rows][width]                  only where there is a fragment behind
// weight       [rows][width]                  (w, w D), the same
// Global size: (units), of DEFRAY_PATTERN_RUN pixels of a row; COLUMNS x STRIP; CHUNK of a row.
// units        (x, y) of the first pixel, in the window
#include "colour.clh"
#include "params.h"

// Of one surface: rays of two such pixels land close together through all of the lens.
uint16 is_close(const int16 a, const int16 b, const uint tolerance) {
  return as_uint16(abs_diff(a, b) <= (uint16)(tolerance));
}

uint16 squared(const uint16 a, const uint16 b, const uint shift) {
  const uint16 d = abs_diff(a >> shift & 255u, b >> shift & 255u);
  return d * d;
}

// From a pixel at this depth to its match; (0, 0) where a parallel shift is too short or too long.
int2 shift_at(const DefrayPatternParams p, const float inverse) {
  const int2 longest = (int2)(p.shift_x, p.shift_y);
  if (p.parallel == 0.0f) return longest;
  const float px = p.parallel * inverse;
  const float most = (float)max(abs(p.shift_x), abs(p.shift_y));
  if (!(px >= (float)DEFRAY_PATTERN_LEAST && px <= most)) return (int2)(0);
  const int length = (int)rint(px);
  return clamp(longest, (int2)(-length), (int2)(length));
}

// The same as the vectors below, for one pixel.
uint difference_at(const DefrayPatternParams p, __global const uint* restrict pixels,
                   __global const int* restrict coc_quanta, const size_t at, const int2 shift) {
  if (shift.x == 0 && shift.y == 0) return 0u;
  const size_t there = (size_t)((long)at + (long)shift.y * p.stride + shift.x);
  const uint a = pixels[at], b = pixels[there];
  const bool is_one_surface = abs_diff(coc_quanta[at], coc_quanta[there]) <= p.tolerance_quanta;
  if (!(a & b & DEFRAY_PATTERN_KNOWN) || !is_one_surface) return 0u;
  const int4 d = (int4)((int)(a & 255u), (int)(a >> 8 & 255u), (int)(a >> 16 & 255u), 0) -
                 (int4)((int)(b & 255u), (int)(b >> 8 & 255u), (int)(b >> 16 & 255u), 0);
  return DEFRAY_PATTERN_KNOWN | (uint)(d.x * d.x + d.y * d.y + d.z * d.z);
}

__kernel void patterns_difference(const DefrayPatternParams p, __global const uint2* restrict units,
                                  __global const uint* restrict pixels,
                                  __global const int* restrict coc_quanta,
                                  __global const float* restrict inverse,
                                  __global uint* restrict difference) {
  if (get_global_id(0) >= p.unit_count) return;
  const uint2 unit = units[get_global_id(0)];
  const size_t at = (size_t)unit.y * p.stride + unit.x;
  for (uint i = 0; i < DEFRAY_PATTERN_RUN && p.parallel != 0.0f; ++i) {
    const int2 shift = shift_at(p, inverse[at + i]);
    difference[at + i] = difference_at(p, pixels, coc_quanta, at + i, shift);
  }
  if (p.parallel != 0.0f) return;
  const size_t there = (size_t)((long)at + (long)p.shift_y * p.stride + p.shift_x);
  const uint16 a = vload16(0, pixels + at), b = vload16(0, pixels + there);
  const uint16 close =
      is_close(vload16(0, coc_quanta + at), vload16(0, coc_quanta + there), p.tolerance_quanta);
  const uint16 pair = a & b & close & DEFRAY_PATTERN_KNOWN;
  const uint16 d = squared(a, b, 0) + squared(a, b, 8) + squared(a, b, 16);
  vstore16(select((uint16)(0u), pair | d, pair != 0u), 0, difference + at);
}

ulong8 pairs_at(__global const uint* restrict difference, const size_t at, const int rows,
                const uint stride) {
  const uint8 v = vload8(0, difference + (size_t)((long)at + (long)rows * stride));
  return convert_ulong8(v >> 24) << DEFRAY_PATTERN_COUNT_BIT | convert_ulong8(v & 0xffffffu);
}

// With weights n - |j|, and the n values before and after that move it on by one:
// sum(x + 1) = sum(x) + values x + 1 ... x + n - values x - n + 1 ... x.
__kernel void patterns_columns(const DefrayPatternParams p, __global const uint2* restrict units,
                               __global const uint* restrict difference,
                               __global ulong* restrict sums) {
  if (get_global_id(0) >= p.unit_count) return;
  const uint2 unit = units[get_global_id(0)];
  const int n = p.window_px;
  size_t at = (size_t)unit.y * p.stride + unit.x;
  ulong8 sum = 0ul, before = 0ul, after = 0ul;
  for (int j = 0; j < n; ++j) {
    before += pairs_at(difference, at, -j, p.stride);
    sum += before;
  }
  for (int j = 1; j < n; ++j) {
    after += pairs_at(difference, at, j, p.stride);
    sum += after;
  }
  after += pairs_at(difference, at, n, p.stride);
  const uint end = min(unit.y + DEFRAY_PATTERN_STRIP, p.margin_y + p.rows);
  for (uint y = unit.y; y < end; ++y, at += p.stride) {
    vstore8(sum, 0, sums + at);
    sum += after - before;
    const ulong8 passing = pairs_at(difference, at, 1, p.stride);
    after += pairs_at(difference, at, n + 1, p.stride) - passing;
    before += passing - pairs_at(difference, at, 1 - n, p.stride);
  }
}

// (w, w D) for a window's sum.
float2 weight_of(const ulong sum) {
  const long squares = (long)(sum & (1ul << DEFRAY_PATTERN_COUNT_BIT) - 1ul);
  const float pairs = (float)(int)(sum >> DEFRAY_PATTERN_COUNT_BIT);
  // White is 255. Two thirds of a step squared more: rounding to 8 bits hides as much.
  const float d = (float)squares / pairs + 0.65025f;
  const float q = 650.25f / d;
  const float q2 = q * q;
  const float w = q2 * q2 * q2;
  return (float2)(w, w * d);
}

__kernel void patterns_match(const DefrayPatternParams p, __global const uint2* restrict units,
                             __global const uint* restrict pixels,
                             __global const int* restrict coc_quanta,
                             __global const ulong* restrict sums,
                             __global const int* restrict behind_coc,
                             __global const float* restrict behind_inverse,
                             CHANNEL_PARAMETERS(channel_behind), CHANNEL_PARAMETERS(channel),
                             __global float4* restrict sum, __global float2* restrict weight) {
  if (get_global_id(0) >= p.unit_count) return;
  const uint2 unit = units[get_global_id(0)];
  const int n = p.window_px;
  const uint x0 = unit.x - p.margin_x, y = unit.y - p.margin_y;
  const size_t first = (size_t)unit.y * p.stride + unit.x;
  ulong window = 0ul, before = 0ul, after = 0ul;
  for (int j = 0; j < n; ++j) {
    before += sums[first - (size_t)j];
    window += before;
  }
  for (int j = 1; j < n; ++j) {
    after += sums[first + (size_t)j];
    window += after;
  }
  after += sums[first + (size_t)n];
  const uint count = min((uint)DEFRAY_PATTERN_CHUNK, p.width - x0);
  for (uint i = 0; i < count; ++i) {
    const size_t at = first + i;
    if (pixels[at] & DEFRAY_PATTERN_BEHIND) {
      const size_t target = (size_t)y * p.width + x0 + i;
      const int2 shift = shift_at(p, behind_inverse[target]);
      const size_t there = (size_t)((long)at + (long)shift.y * p.stride + shift.x);
      const bool is_match = pixels[there] & DEFRAY_PATTERN_KNOWN &&
                            window >> DEFRAY_PATTERN_COUNT_BIT >= p.least_pairs &&
                            abs_diff(coc_quanta[there], behind_coc[target]) <= p.tolerance_quanta;
      if (is_match || p.is_first) {
        float4 total = p.is_first ? (float4)(0.0f) : sum[target];
        float2 weights = p.is_first ? (float2)(0.0f) : weight[target];
        if (is_match) {
          const size_t source =
              (size_t)((long)(p.source_row + y) + shift.y) * p.width + (x0 + i) + shift.x;
          const float2 w = weight_of(window);
          total += w.x * (colour_at(CHANNELS(channel), source) -
                          colour_at(CHANNELS(channel_behind), target));
          weights += w;
        }
        sum[target] = total;
        weight[target] = weights;
      }
    }
    window += after - before;
    const ulong passing = sums[at + 1];
    after += sums[at + (size_t)n + 1] - passing;
    before += passing - sums[at + 1 - (size_t)n];
  }
}
