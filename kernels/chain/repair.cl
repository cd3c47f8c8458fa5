// repair: depth that was anti-aliased, pixels of which lie between two surfaces and on neither.
//
// Such depth is a mean of two surfaces', and so is the colour of its pixel, in the same shares.
// What truly lies between two surfaces, thin things and rims, has its own colour: whether a pixel
// is one or the other is decided by many of them (host/chain/steps/antialiased.h).
//
// coc_quanta   [height][width]  signed radius, 1/256 px
// depth_units  [height][width]  planar depth, scene units
// channel0..3  [height][width]  linear colour
// ramps        [height][width]  0, or of a pixel between two surfaces what DEFRAY_RAMP_MIXES says
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "base/colour.clh"
#include "base/run.clh"

// By an array: where Oclgrind looks for uninitialised reads, parts of vectors end it.
float square_of(const float4 v) {
  float squares[4];
  vstore4(v * v, 0, squares);
  return squares[0] + squares[1] + squares[2] + squares[3];
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
// one end is half of a step away at least. (Without this look first the stage takes 1.7 times as
// long on fence bg, three times on spheres f3.)
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

// A way through a pixel, of sixteen: its ends are looked for one and two pixels away, as a ramp may
// be one or two pixels wide.
typedef struct {
  int2 back, ahead, step;
} Line;

Line line_of(const int i) {
  const int2 directions[4] = {(int2)(1, 0), (int2)(0, 1), (int2)(1, 1), (int2)(1, -1)};
  const int2 d = directions[i % 4];
  const Line line = {-(1 + i / 4 % 2) * d, (1 + i / 8) * d, d};
  return line;
}

// Which pixels of a run are on a ramp along a way: flat, then steadily up or down through the
// pixel, then flat, all to 1/8 of it: so far a pixel's depth may be off. Rims of round things come
// closer to one end.
int16 has_ramp(const DefrayFrameParams p, __global const int* restrict coc_quanta, const int2 start,
               const Line line) {
  const int16 low = coc_of_run(p.width, p.height, coc_quanta, start + line.back);
  const int16 high = coc_of_run(p.width, p.height, coc_quanta, start + line.ahead);
  const int16 rise = apart(high, low), eighth = rise >> 3;
  const int16 is_steep = rise > (int16)(DEFRAY_RAMP_QUANTA);
  // Not any_lane: where Oclgrind looks for uninitialised reads, halves of vectors end it.
  if (!any(is_steep)) return 0;
  const int16 own = coc_of_run(p.width, p.height, coc_quanta, start);
  const int16 before = coc_of_run(p.width, p.height, coc_quanta, start + line.back - line.step);
  const int16 after = coc_of_run(p.width, p.height, coc_quanta, start + line.ahead + line.step);
  const int16 is_between = own > min(low, high) + eighth & own < max(low, high) - eighth;
  return is_steep & is_between & apart(low, before) < eighth & apart(after, high) < eighth;
}

// What is said of a pixel that is on a ramp along a way: its end that is nearer in CoC.
uint ramp_at(const DefrayFrameParams p, __global const int* restrict coc_quanta,
             __global const float* restrict depth_units, CHANNEL_PARAMETERS(channel), const int2 at,
             const Line line) {
  const uint own = pixel_at(p.width, p.height, at);
  const uint low = pixel_at(p.width, p.height, at + line.back);
  const uint high = pixel_at(p.width, p.height, at + line.ahead);
  const int to_low = abs(coc_of(coc_quanta, own) - coc_of(coc_quanta, low));
  const int to_high = abs(coc_of(coc_quanta, own) - coc_of(coc_quanta, high));
  const int2 end = to_low <= to_high ? line.back : line.ahead;
  const uint flag = mixes(depth_units, CHANNELS(channel), low, own, high) ? DEFRAY_RAMP_MIXES : 0u;
  return (uint)(1 + (2 + end.x) + 5 * (2 + end.y)) | flag;
}

__kernel void repair(const DefrayFrameParams p, __global const int* restrict coc_quanta,
                     __global const float* restrict depth_units, CHANNEL_PARAMETERS(channel),
                     __global uint* restrict ramps) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  store_ints(p.width, (__global int*)ramps, start, (int16)(0));
  if (all(is_level(p, coc_quanta, start))) return;
  int16 first_line = 16;
  for (int i = 15; i >= 0; --i) {
    const int16 is_ramp = has_ramp(p, coc_quanta, start, line_of(i));
    first_line = (is_ramp & (int16)(i)) | (~is_ramp & first_line);
  }
  int lines[RUN];
  vstore16(first_line, 0, lines);
  const uint first = pixel_at(p.width, p.height, start);
  for (int i = 0; i < run_length(p.width, start); ++i) {
    if (lines[i] == 16) continue;
    const int2 at = start + (int2)(i, 0);
    ramps[first + (uint)i] =
        ramp_at(p, coc_quanta, depth_units, CHANNELS(channel), at, line_of(lines[i]));
  }
}
