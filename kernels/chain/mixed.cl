// mixed: where one surface ends before another.
//
// The signed CoC orders surfaces as depth does, and a step of it says by how many pixels the lens
// parts the two: only steps above 3/4 of a pixel (DEFRAY_JUMP_QUANTA) matter, whatever the scene's
// scale. Up to 2 px (DEFRAY_RAMP_QUANTA) a step like those before and after it parts nothing: a
// surface slants there, and goes on.
//
// coc_quanta  [height][width]  signed radius, 1/256 px
// mixed       [height][width]  1 where a neighbour lies on another surface: anti-aliased colour
//                              holds both there
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "base/run.clh"

// The sign's bit; of comparisons between vectors Oclgrind keeps other bits.
int16 is_above(const int16 value, const int limit) {
  return as_int16(as_uint16((int16)(limit)-value) >> 31u);
}

// 1 where a pixel of a run and its neighbour lie on two surfaces.
int16 parts(const DefrayFrameParams p, __global const int* restrict coc_quanta, const int2 start,
            const int2 d) {
  const int16 before = coc_of_run(p.width, p.height, coc_quanta, start - d);
  const int16 own = coc_of_run(p.width, p.height, coc_quanta, start);
  const int16 other = coc_of_run(p.width, p.height, coc_quanta, start + d);
  const int16 after = coc_of_run(p.width, p.height, coc_quanta, start + 2 * d);
  const int16 bend = min(apart(other - own, own - before), apart(after - other, other - own));
  return is_above(apart(other, own), DEFRAY_JUMP_QUANTA) &
         (is_above(apart(other, own), DEFRAY_RAMP_QUANTA) | is_above(bend, DEFRAY_BEND_QUANTA));
}

__kernel void mixed(const DefrayFrameParams p, __global const int* restrict coc_quanta,
                    __global uint* restrict mixed) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  const int16 own = coc_of_run(p.width, p.height, coc_quanta, start);
  int16 largest = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int16 coc = coc_of_run(p.width, p.height, coc_quanta, start + (int2)(i, j));
      largest = max(largest, apart(coc, own));
    }
  }
  int16 is_mixed = 0;
  // Not any_lane: where Oclgrind looks for uninitialised reads, halves of vectors end it.
  if (any((int16)(DEFRAY_JUMP_QUANTA)-largest)) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) is_mixed |= parts(p, coc_quanta, start, (int2)(i, j));
    }
  }
  store_ints(p.width, (__global int*)mixed, start, is_mixed);
}
