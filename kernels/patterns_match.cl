// patterns_match: what one shift of the picture gives to hidden pixels (patterns.cl).
//
// Sums over columns, summed along rows with weights n - |dx|, give D, the mean squared difference
// of the surroundings of a pixel and its match; then its weight w = (1/100 / D)^6, D in units of
// white squared, and the sums of w, w D and w (colour of the match - smooth colour behind the
// pixel).
//
// units, pixels, coc_quanta, columns          as in patterns.cl
// behind_coc   [rows][width]                  radius of the synthesised fragment
// behind_inverse [rows][width]                its 1/depth
// channel_behind0..3  [rows][width]           its colour, before: smooth
// channel0..3  [from source_row rows above the band on][width]   linear colours of the frame
// sums         [6][rows][width] of the four channels, of w, of w D; where there is a fragment
//              behind
// Global size: (units), of DEFRAY_PATTERN_CHUNK pixels of a row.
#include "colour.clh"
#include "params.h"
#include "patterns_shift.clh"

// A window's weight, and its mean squared difference times that; eight windows.
typedef struct {
  float8 w, square_w;
} Weights;

Weights weights_of(const ulong8 windows) {
  const long8 squares = convert_long8(windows & (1ul << DEFRAY_PATTERN_COUNT_BIT) - 1ul);
  const float8 pairs = convert_float8(convert_int8(windows >> DEFRAY_PATTERN_COUNT_BIT));
  // White is 255. Two thirds of a step squared more: rounding to 8 bits hides as much.
  const float8 d = convert_float8(squares) / pairs + 0.65025f;
  const float8 q = 650.25f / d;
  const float8 q2 = q * q;
  const float8 w = q2 * q2 * q2;
  const Weights weights = {w, w * d};
  return weights;
}

// Eight values, from so far on; beside each other from the first one on, or anywhere.
int8 eight_ints(__global const int* restrict plane, const int8 places, const bool are_beside) {
  if (are_beside) return vload8(0, plane + places.s0);
  int from[8], values[8];
  vstore8(places, 0, from);
  for (int i = 0; i < 8; ++i) values[i] = plane[from[i]];
  return vload8(0, values);
}

float8 eight_floats(__global const float* restrict plane, const int8 places,
                    const bool are_beside) {
  return as_float8(eight_ints((__global const int*)plane, places, are_beside));
}

// Where eight pixels of a row may find what lies behind them, their surroundings aside.
typedef struct {
  int8 shift_x, shift_y, is_match;
} Matches;

// Of `count` pixels, from `at` in the window and `target` in the band on.
Matches matches_of(const DefrayPatternsParams p, __global const uint* restrict pixels,
                   __global const int* restrict coc_quanta, __global const int* restrict behind_coc,
                   __global const float* restrict behind_inverse, const size_t at,
                   const size_t target, const int count) {
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const int8 is_behind =
      lane < (int8)(count) && as_int8(vload8(0, pixels + at) & DEFRAY_PATTERN_BEHIND) != (int8)(0);
  Matches m = {p.shift_x, p.shift_y, 0};
  if (!any(is_behind)) return m;
  const bool is_parallel = p.parallel != 0.0f;
  if (is_parallel) {
    int xs[8], ys[8], looks[8];
    vstore8(is_behind, 0, looks);
    for (int i = 0; i < 8; ++i) {
      const int2 shift = looks[i] ? shift_at(p, behind_inverse[target + (uint)i]) : (int2)(0);
      xs[i] = shift.x;
      ys[i] = shift.y;
    }
    m.shift_x = vload8(0, xs);
    m.shift_y = vload8(0, ys);
  }
  const bool is_whole = count == 8;
  const int8 own = is_whole ? lane : select((int8)(0), lane, is_behind);
  const int8 there = lane + m.shift_y * (int)p.stride + m.shift_x;
  const int8 flags = eight_ints((__global const int*)pixels + at, there, !is_parallel);
  const int8 coc = eight_ints(coc_quanta + at, there, !is_parallel);
  const uint8 apart = abs_diff(coc, eight_ints(behind_coc + target, own, is_whole));
  m.is_match = is_behind && (flags & (int)DEFRAY_PATTERN_KNOWN) != (int8)(0) &&
               apart <= (uint8)(p.tolerance_quanta);
  return m;
}

// A plane of `sums`: values are added where there is a match.
void add_to(__global float* sum, const int count, const int8 is_match, const float8 values) {
  if (count == 8) {
    const float8 old = vload8(0, sum);
    vstore8(select(old, old + values, is_match), 0, sum);
    return;
  }
  float added[8];
  vstore8(select((float8)(-0.0f), values, is_match), 0, added);
  for (int i = 0; i < count; ++i) sum[i] += added[i];
}

// What a shift gives to `count` pixels of a row, (x, y) in the band and on, in these windows.
void add_matches(const DefrayPatternsParams p, CHANNEL_PARAMETERS(channel_behind),
                 CHANNEL_PARAMETERS(channel), __global float* restrict sums, const Matches m,
                 const ulong8 windows, const int x, const int y, const int count) {
  const uint8 pairs = convert_uint8(windows >> DEFRAY_PATTERN_COUNT_BIT);
  const int8 is_match = m.is_match && pairs >= (uint8)(p.least_pairs);
  if (!any(is_match)) return;
  // Where there is a match its row is in the frame; the rest of the eight may not be.
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const int from_x = x + p.shift_x;
  const bool are_beside = p.parallel == 0.0f && from_x >= 0 && from_x + 8 <= (int)p.width;
  const int8 beside = lane + m.shift_y * (int)p.width + m.shift_x;
  const int8 places = are_beside ? beside : select((int8)(0), beside, is_match);
  const bool is_whole = count == 8;
  const int8 own = is_whole ? lane : select((int8)(0), lane, is_match);
  const size_t source = (size_t)(p.source_row + (uint)y) * p.width + (uint)x;
  const size_t target = (size_t)y * p.width + (uint)x;
  const size_t plane = (size_t)p.rows * p.width;
  const Weights weights = weights_of(windows);
#define ADD_CHANNEL(i)                                                        \
  add_to(sums + i * plane + target, count, is_match,                          \
         weights.w * (eight_floats(channel##i + source, places, are_beside) - \
                      eight_floats(channel_behind##i + target, own, is_whole)))
  ADD_CHANNEL(0);
  ADD_CHANNEL(1);
  ADD_CHANNEL(2);
  ADD_CHANNEL(3);
  add_to(sums + 4 * plane + target, count, is_match, weights.w);
  add_to(sums + 5 * plane + target, count, is_match, weights.square_w);
}

__kernel void patterns_match(const DefrayPatternsParams p, __global const uint2* restrict units,
                             __global const uint* restrict pixels,
                             __global const int* restrict coc_quanta,
                             __global const ulong* restrict columns,
                             __global const int* restrict behind_coc,
                             __global const float* restrict behind_inverse,
                             CHANNEL_PARAMETERS(channel_behind), CHANNEL_PARAMETERS(channel),
                             __global float* restrict sums) {
  if (get_global_id(0) >= p.unit_count) return;
  const uint2 unit = units[get_global_id(0)];
  const int x = (int)(unit.x - p.margin_x), y = (int)(unit.y - p.margin_y);
  const int count = min(DEFRAY_PATTERN_CHUNK, (int)p.width - x);
  const size_t in_window = (size_t)unit.y * p.stride + unit.x;
  const size_t in_band = (size_t)y * p.width + (uint)x;
  for (int i = 0; p.is_first && i < 6 * count; ++i) {
    sums[(size_t)(i / count) * p.rows * p.width + in_band + (size_t)(i % count)] = 0.0f;
  }
  // Windows are needed from the first match to the last.
  Matches matches[DEFRAY_PATTERN_CHUNK / 8];
  int begin = count, end = 0;
  for (int i = 0; i < count; i += 8) {
    matches[i / 8] = matches_of(p, pixels, coc_quanta, behind_coc, behind_inverse,
                                in_window + (size_t)i, in_band + (size_t)i, min(8, count - i));
    if (!any(matches[i / 8].is_match)) continue;
    begin = min(begin, i);
    end = i + 8;
  }
  if (begin >= end) return;

  const size_t n = (size_t)p.window_px, first = in_window + (size_t)begin;
  ulong window = 0ul, before = 0ul, after = 0ul;
  for (size_t j = 0; j < n; ++j) {
    before += columns[first - j];
    window += before;
  }
  for (size_t j = 1; j < n; ++j) {
    after += columns[first + j];
    window += after;
  }
  after += columns[first + n];
  for (int i = begin; i < end; i += 8) {
    ulong windows[8];
    for (size_t k = 0; k < 8; ++k) {
      const size_t at = in_window + (size_t)i + k;
      windows[k] = window;
      window += after - before;
      const ulong passing = columns[at + 1];
      after += columns[at + n + 1] - passing;
      before += passing - columns[at + 1 - n];
    }
    add_matches(p, CHANNELS(channel_behind), CHANNELS(channel), sums, matches[i / 8],
                vload8(0, windows), x + i, y, min(8, count - i));
  }
}
