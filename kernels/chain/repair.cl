// repair: depth that was anti-aliased, pixels of which lie between two surfaces and on neither.
//
// Such depth is a mean of two surfaces', and so is the colour of its pixel, in the same shares.
// What truly lies between two surfaces, thin things and rims, has its own colour: whether a pixel
// is one or the other is decided by many of them (host/chain/antialiased.h).
//
// coc_quanta   [height][width]  signed radius, 1/256 px
// depth_units  [height][width]  planar depth, scene units
// channel0..3  [height][width]  linear colour
// ramps        [height][width]  0, or of a pixel between two surfaces what DEFRAY_RAMP_MIXES says
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "base/colour.clh"
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

float square_of(const float4 v) {
  const float4 squares = v * v;
  return squares.x + squares.y + squares.z + squares.w;
}

// Whether a pixel's colour is closer to the mean of two others than to each of them, in the shares
// that its depth has of theirs: depth was averaged, or 1/depth. What is not finite is no mean.
bool mixes(__global const float* restrict depth_units, CHANNEL_PARAMETERS(channel), const uint low,
           const uint own, const uint high) {
  const float4 from_low = colour_at(CHANNELS(channel), own) - colour_at(CHANNELS(channel), low);
  const float4 step = colour_at(CHANNELS(channel), high) - colour_at(CHANNELS(channel), low);
  const float share =
      (depth_units[own] - depth_units[low]) / (depth_units[high] - depth_units[low]);
  const float share_of_inverse = share * depth_units[high] / depth_units[own];
  const float to_low = square_of(from_low), to_high = square_of(from_low - step);
  const float of_depth = square_of(from_low - share * step);
  const float of_inverse = square_of(from_low - share_of_inverse * step);
  return (of_depth < to_low && of_depth < to_high) || (of_inverse < to_low && of_inverse < to_high);
}

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

// What is said of one pixel.
uint ramp_at(const DefrayFrameParams p, __global const int* restrict coc_quanta,
             __global const float* restrict depth_units, CHANNEL_PARAMETERS(channel),
             const int2 at) {
  const int2 directions[4] = {(int2)(1, 0), (int2)(0, 1), (int2)(1, 1), (int2)(1, -1)};
  const uint own = pixel_at(p.width, p.height, at);
  uint found = 0u;
  // A ramp may be one or two pixels wide: its ends are looked for one and two pixels away.
  for (int i = 0; i < 16 && found == 0u; ++i) {
    const int2 d = directions[i % 4];
    const int back = 1 + i / 4 % 2, ahead = 1 + i / 8;
    const uint low = pixel_at(p.width, p.height, at - back * d);
    const uint high = pixel_at(p.width, p.height, at + ahead * d);
    const int side =
        ramp(coc_of(coc_quanta, pixel_at(p.width, p.height, at - (back + 1) * d)),
             coc_of(coc_quanta, low), coc_of(coc_quanta, own), coc_of(coc_quanta, high),
             coc_of(coc_quanta, pixel_at(p.width, p.height, at + (ahead + 1) * d)));
    const int2 end = side < 0 ? -back * d : ahead * d;
    if (side != 0) {
      found = (uint)(1 + (2 + end.x) + 5 * (2 + end.y));
      if (mixes(depth_units, CHANNELS(channel), low, own, high)) found |= DEFRAY_RAMP_MIXES;
    }
  }
  return found;
}

__kernel void repair(const DefrayFrameParams p, __global const int* restrict coc_quanta,
                     __global const float* restrict depth_units, CHANNEL_PARAMETERS(channel),
                     __global uint* restrict ramps) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  store_ints(p.width, (__global int*)ramps, start, (int16)(0));
  const int16 level = is_level(p, coc_quanta, start);
  // Not all_lanes: where Oclgrind looks for uninitialised reads, halves of vectors end it.
  if (all(level)) return;
  int is_done[RUN];
  vstore16(level, 0, is_done);
  const uint first = pixel_at(p.width, p.height, start);
  for (int i = 0; i < run_length(p.width, start); ++i) {
    if (is_done[i]) continue;
    ramps[first + (uint)i] =
        ramp_at(p, coc_quanta, depth_units, CHANNELS(channel), start + (int2)(i, 0));
  }
}
