// repair, mixed: where one surface ends before another.
//
// The signed CoC orders surfaces as depth does, and a step of it says by how many pixels the lens
// parts the two: only steps above 3/4 of a pixel (DEFRAY_JUMP_QUANTA) matter, whatever the scene's
// scale. Up to 2 px (DEFRAY_RAMP_QUANTA) a step like those before and after it parts nothing: a
// surface slants there, and goes on.
//
// coc_quanta  [height][width]  signed radius, 1/256 px
// source      [height][width]  repair: index of the pixel whose depth a pixel should have: its own,
//                              or, where depth was anti-aliased, one of the two surfaces' that it
//                              lies between
// mixed       [height][width]  mixed: 1 where a neighbour lies on another surface: anti-aliased
//                              colour holds both there
// Global size of both: (runs of DEFRAY_RUN pixels of a row, height).
#include "base/run.clh"

// A ramp along a line of pixels: flat, then steadily up or down through the middle one, then flat,
// all to 1/8 of it: so far a pixel's depth may be off. Rims of round things come closer to one end.
// Returns -1 or 1, the end of it that is nearer in CoC, or 0 where there is none.
int ramp(const int before, const int low, const int middle, const int high, const int after) {
  const int rise = high - low;
  const int from_low = middle - low, to_high = high - middle;
  const bool is_steep = abs(rise) > DEFRAY_RAMP_QUANTA;
  const bool is_between = (rise > 0) == (from_low > 0) && (rise > 0) == (to_high > 0) &&
                          abs(from_low) > abs(rise) / 8 && abs(to_high) > abs(rise) / 8;
  const bool is_flat = abs(low - before) < abs(rise) / 8 && abs(after - high) < abs(rise) / 8;
  if (!is_steep || !is_between || !is_flat) return 0;
  return abs(from_low) <= abs(to_high) ? -1 : 1;
}

// How far apart limited radii are, signed: all the same to Oclgrind, whose unsigned vectors are
// not.
int16 apart(const int16 a, const int16 b) { return max(a, b) - min(a, b); }

// Where all that may be an end of a ramp is close to its middle: there is none then. Of a steep one
// one end is half of a step away at least.
int16 is_level(const DefrayFrameParams p, __global const int* restrict coc_quanta,
               const int2 start) {
  const int16 own = coc_of_run(p.width, p.height, coc_quanta, start);
  int16 largest = 0;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      const int16 coc = coc_of_run(p.width, p.height, coc_quanta, start + (int2)(x, y));
      largest = max(largest, apart(coc, own));
    }
  }
  return largest <= (int16)(DEFRAY_RAMP_QUANTA / 2);
}

// The pixel whose depth a pixel should have.
uint repaired(const DefrayFrameParams p, __global const int* restrict coc_quanta, const int2 at) {
  const int2 directions[4] = {(int2)(1, 0), (int2)(0, 1), (int2)(1, 1), (int2)(1, -1)};
  uint found = pixel_at(p.width, p.height, at);
  const int own = coc_of(coc_quanta, found);
  bool done = false;
  // A ramp may be one or two pixels wide: its ends are looked for one and two pixels away.
  for (int i = 0; i < 16 && !done; ++i) {
    const int2 d = directions[i % 4];
    const int back = 1 + i / 4 % 2, ahead = 1 + i / 8;
    const uint low = pixel_at(p.width, p.height, at - back * d);
    const uint high = pixel_at(p.width, p.height, at + ahead * d);
    const int side = ramp(coc_of(coc_quanta, pixel_at(p.width, p.height, at - (back + 1) * d)),
                          coc_of(coc_quanta, low), own, coc_of(coc_quanta, high),
                          coc_of(coc_quanta, pixel_at(p.width, p.height, at + (ahead + 1) * d)));
    if (side != 0) found = side < 0 ? low : high;
    done = side != 0;
  }
  return found;
}

__kernel void repair(const DefrayFrameParams p, __global const int* restrict coc_quanta,
                     __global uint* restrict source) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  const uint first = pixel_at(p.width, p.height, start);
  store_ints(p.width, (__global int*)source, start, (int16)((int)first) + RUN_LANES);
  const int16 level = is_level(p, coc_quanta, start);
  // Not all_lanes: where Oclgrind looks for uninitialised reads, halves of vectors end it.
  if (all(level)) return;
  int is_done[RUN];
  vstore16(level, 0, is_done);
  for (int i = 0; i < run_length(p.width, start); ++i) {
    if (!is_done[i]) source[first + (uint)i] = repaired(p, coc_quanta, start + (int2)(i, 0));
  }
}

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
  // Not any_lane, as above.
  if (any((int16)(DEFRAY_JUMP_QUANTA)-largest)) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) is_mixed |= parts(p, coc_quanta, start, (int2)(i, j));
    }
  }
  store_ints(p.width, (__global int*)mixed, start, is_mixed);
}
