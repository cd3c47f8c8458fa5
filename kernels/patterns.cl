// patterns_difference, patterns_columns: how well the surroundings of a pixel x agree with those of
// x + s, for one shift s of the whole picture.
//
// Periodic and repeating surfaces look alike at a few shifts (He & Sun 2012, "Statistics of patch
// offsets for image completion"). The better both agree, the more the colour of x + s says about
// what x hides: patterns_match.cl. Where a floor or a wall slants, its pattern repeats at one
// distance in the scene: then s is parallel to the picture there, and as long in it as the surface
// is near.
//
// patterns_difference   squared difference of the 8-bit colours of x and x + s, where both are
//                       known and of one surface (similar CoC)
// patterns_columns      its sums over columns with weights n - |dy|: a box of n rows, twice
//
// Differences and their sums are integers: exact, whatever the order, so that sums may run along.
// All planes are windows of [window rows][stride] (DefrayPatternsParams).
//
// units        (x, y) of the first pixel, in the window
// pixels       8-bit colour, known and behind flags (params.h)
// coc_quanta   signed radius, 1/256 px
// inverse      1/depth
// difference   bit 24: a pair; below: its squared difference
// columns      number of pairs << 40 | squared differences, weighted
// Global size: (units), of DEFRAY_PATTERN_RUN pixels of a row; COLUMNS x STRIP.
#include "params.h"
#include "patterns_shift.clh"

// Of one surface: rays of two such pixels land close together through all of the lens.
uint16 is_close(const int16 a, const int16 b, const uint tolerance) {
  return as_uint16(abs_diff(a, b) <= (uint16)(tolerance));
}

uint16 squared(const uint16 a, const uint16 b, const uint shift) {
  const uint16 d = abs_diff(a >> shift & 255u, b >> shift & 255u);
  return d * d;
}

// The same as the vectors below, for one pixel.
uint difference_at(const DefrayPatternsParams p, __global const uint* restrict pixels,
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

__kernel void patterns_difference(const DefrayPatternsParams p,
                                  __global const uint2* restrict units,
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
__kernel void patterns_columns(const DefrayPatternsParams p, __global const uint2* restrict units,
                               __global const uint* restrict difference,
                               __global ulong* restrict columns) {
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
    vstore8(sum, 0, columns + at);
    sum += after - before;
    const ulong8 passing = pairs_at(difference, at, 1, p.stride);
    after += pairs_at(difference, at, n + 1, p.stride) - passing;
    before += passing - pairs_at(difference, at, 1 - n, p.stride);
  }
}
