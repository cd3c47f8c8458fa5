// patterns_difference: how well the pixels x of a cell agree with those of x + s, for each shift s
// of the picture.
//
// Periodic and repeating surfaces look alike at a few shifts (He & Sun 2012, "Statistics of patch
// offsets for image completion"). The better both agree, the more the colour of x + s says about
// what x hides: patterns_match.cl. Where a floor or a wall slants, its pattern repeats at one
// distance in the scene: then s is parallel to the picture there, and as long in it as the surface
// is near.
//
// Sums are integers: exact, whatever the order. Pixels are a window of the frame, [height][width].
//
// shifts      [shift_count]
// needed      [rows of cells of the window][units]  whether a match's window holds the unit's cells
// pixels      8-bit colour, known and behind flags (params.h)
// coc_quanta  signed radius, 1/256 px
// inverse     1/depth
// cells       [shift_count][cell_rows][units + 2 DEFRAY_PATTERN_MARGIN][DEFRAY_PATTERN_UNIT]
//             squared differences of 8-bit colours where both are known and of one surface (similar
//             CoC), and how many such pairs there are (params.h); 0 where not needed
// Global size: (units + 2 DEFRAY_PATTERN_MARGIN, cell_rows).
#include "chain/patterns_shift.clh"

uint16 squared(const uint16 a, const uint16 b, const uint shift) {
  const uint16 d = (a >> shift & 255u) - (b >> shift & 255u);
  return d * d;
}

// A row of a unit's pixels: 1 << 24 and the squared difference where there is a pair, else 0.
uint16 pairs_of(const DefrayPatternsParams p, const DefrayPatternShift shift,
                __global const int* restrict pixels, __global const int* restrict coc_quanta,
                __global const float* restrict inverse, const int2 start) {
  const Matches own = itself(p, start);
  const uint16 a = words_at(pixels, own);
  if (!any_lane(as_int16(a & DEFRAY_PATTERN_KNOWN))) return (uint16)(0u);
  const bool is_parallel = shift.parallel != 0.0f;
  const float16 depth = is_parallel ? floats_at(inverse, own.places) : (float16)(0.0f);
  const Matches there = matches_of(p, shift, start, depth);
  const uint16 b = words_at(pixels, there);
  const uint16 close =
      as_uint16(are_close(p, ints_at(coc_quanta, own.places), ints_at(coc_quanta, there.places)));
  const uint16 pair = a & b & close & DEFRAY_PATTERN_KNOWN;
  const uint16 d = squared(a, b, 0) + squared(a, b, 8) + squared(a, b, 16);
  return select((uint16)(0u), pair | d, pair != 0u);
}

__kernel void patterns_difference(const DefrayPatternsParams p,
                                  __global const DefrayPatternShift* restrict shifts,
                                  __global const uint* restrict needed,
                                  __global const int* restrict pixels,
                                  __global const int* restrict coc_quanta,
                                  __global const float* restrict inverse,
                                  __global uint* restrict cells) {
  const int units = ((int)p.width + RUN - 1) / RUN;
  const int column = (int)get_global_id(0), unit = column - DEFRAY_PATTERN_MARGIN;
  const int columns = units + 2 * DEFRAY_PATTERN_MARGIN;
  const int row = (int)get_global_id(1), first = p.first_row + DEFRAY_PATTERN_CELL * row;
  if (column >= columns || row >= (int)p.cell_rows) return;
  const bool is_inside = unit >= 0 && unit < units && first >= 0 && first < (int)p.height;
  const bool is_needed = is_inside && needed[first / DEFRAY_PATTERN_CELL * units + unit];
  __global uint* to = cells + (row * columns + column) * DEFRAY_PATTERN_UNIT;
  for (uint i = 0; i < p.shift_count;
       ++i, to += p.cell_rows * (uint)columns * DEFRAY_PATTERN_UNIT) {
    uint16 sum = 0u;
    for (int j = 0; is_needed && j < DEFRAY_PATTERN_CELL && first + j < (int)p.height; ++j) {
      const int2 start = (int2)(unit * RUN, first + j);
      sum += pairs_of(p, shifts[i], pixels, coc_quanta, inverse, start);
    }
    vstore4(sum.s048c + sum.s159d + sum.s26ae + sum.s37bf, 0, to);
  }
}
