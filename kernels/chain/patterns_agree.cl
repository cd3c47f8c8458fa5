// patterns_agree: how well a picture agrees with itself shifted, in the mean over all of it: for
// the search for the shifts at which it repeats itself (host/chain/patterns). Sums are integers:
// exact, whatever the order.
//
// shifts      [shift_count]  none of them parallel
// pixels      [height][width]  8-bit colour and known flag (patterns_params.h)
// coc_quanta  [height][width]  signed radius, 1/256 px
// sums        [parts][shift_count]  squared differences where both are known and of one surface,
//                                   and how many such pairs there are
// Global size: (shift_count, parts of the rows).
#include "base/run.clh"
#include "patterns_params.h"

typedef struct {
  uint16 squares, pairs;
} LaneSums;

INLINED uint16 squared_distance(const int16 a, const int16 b) {
  const int16 r = (a & 255) - (b & 255), g = (a >> 8 & 255) - (b >> 8 & 255);
  const int16 blue = (a >> 16 & 255) - (b >> 16 & 255);
  return as_uint16(r * r + g * g + blue * blue);
}

// Pairs of the lanes that are `fresh`: -1 or 0.
INLINED void add_lanes(LaneSums* sums, const uint tolerance, const int16 a, const int16 b,
                       const int16 coc, const int16 other_coc, const int16 fresh) {
  // Radii go up to 2^30: their difference fits 32 bits without a sign.
  const uint16 apart_by = as_uint16(coc) - as_uint16(other_coc) + tolerance;
  const int16 is_pair =
      fresh & (apart_by <= (uint16)(2u * tolerance)) & ((a & b & (int)DEFRAY_PATTERN_KNOWN) != 0);
  sums->squares += as_uint16(is_pair) & squared_distance(a, b);
  sums->pairs -= as_uint16(is_pair);
}

// A run with another.
INLINED void add_run(const DefrayAgreeParams p, __global const int* restrict pixels,
                     __global const int* restrict coc_quanta, const size_t at, const size_t there,
                     const int16 fresh, LaneSums* sums) {
  add_lanes(sums, (uint)p.tolerance_quanta, vload16(0, pixels + at), vload16(0, pixels + there),
            vload16(0, coc_quanta + at), vload16(0, coc_quanta + there), fresh);
}

// Fewer pixels than a run has.
void add_few(const DefrayAgreeParams p, __global const int* restrict pixels,
             __global const int* restrict coc_quanta, const int2 start, const int2 there,
             const int count, LaneSums* sums) {
  add_lanes(sums, (uint)p.tolerance_quanta, ints_of_run(p.width, p.height, pixels, start),
            ints_of_run(p.width, p.height, pixels, there),
            ints_of_run(p.width, p.height, coc_quanta, start),
            ints_of_run(p.width, p.height, coc_quanta, there), RUN_LANES < (int16)(count));
}

// Those of a row: `count` pixels from `start` on, with as many from `there` on.
INLINED void add_row(const DefrayAgreeParams p, __global const int* restrict pixels,
                     __global const int* restrict coc_quanta, const int2 start, const int2 there,
                     const int count, LaneSums* sums) {
  if (count < RUN) {
    add_few(p, pixels, coc_quanta, start, there, count, sums);
    return;
  }
  const size_t at = (size_t)start.y * p.width + (size_t)start.x;
  const size_t to = (size_t)there.y * p.width + (size_t)there.x;
  int i = 0;
  for (; i + RUN <= count; i += RUN) {
    add_run(p, pixels, coc_quanta, at + (size_t)i, to + (size_t)i, -1, sums);
  }
  // The row's last run, but for pixels that were there before.
  const int last = count - RUN;
  if (i < count) {
    add_run(p, pixels, coc_quanta, at + (size_t)last, to + (size_t)last,
            last + RUN_LANES >= (int16)(i), sums);
  }
}

ulong sum_of_lanes(const uint16 v) {
  const ulong8 a = convert_ulong8(v.lo) + convert_ulong8(v.hi);
  const ulong4 b = a.lo + a.hi;
  const ulong2 c = b.lo + b.hi;
  return c.x + c.y;
}

// The first row from `row` on that is one of `step` from `first` on.
int next_row(const int row, const int first, const int step) {
  return row <= first ? first : first + (row - first + step - 1) / step * step;
}

__kernel void patterns_agree(const DefrayAgreeParams p,
                             __global const DefrayPatternShift* restrict shifts,
                             __global const int* restrict pixels,
                             __global const int* restrict coc_quanta,
                             __global DefrayAgreement* restrict sums) {
  const uint i = (uint)get_global_id(0), part = (uint)get_global_id(1);
  const int first = p.first_row + (int)part * p.part_rows;
  if (i >= p.shift_count || first >= p.end_row) return;
  const int2 shift = (int2)(shifts[i].x, shifts[i].y);
  const int end = min(min(first + p.part_rows, p.end_row), (int)p.height - max(0, shift.y));
  const int x = max(0, -shift.x), count = (int)p.width - abs(shift.x);
  LaneSums lanes = {0u, 0u};
  const int from = next_row(first, max(0, -shift.y) - p.above, p.row_step);
  for (int y = from; count > 0 && y < end; y += p.row_step) {
    add_row(p, pixels, coc_quanta, (int2)(x, y), (int2)(x, y) + shift, count, &lanes);
  }
  const DefrayAgreement sum = {sum_of_lanes(lanes.squares), sum_of_lanes(lanes.pairs)};
  sums[part * p.shift_count + i] = sum;
}
