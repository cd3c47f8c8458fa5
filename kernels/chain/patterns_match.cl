// patterns_match: what lies behind, moved towards where the picture agrees with it (patterns.cl).
//
// Of each shift, the cells around a pixel give D, the mean squared difference of its surroundings
// and its match's, with the frame's mean as of frame_pairs pairs more: the fewer are known, the
// less is chance believed. Then the shift's weight is w = (1/100 / D)^6, D in units of white
// squared. Colours move towards the matches' mean by the gain of linear regression, covariance /
// variance = 1 - D / 2 V, clamped to 0...1: not at all where surroundings agree by chance only.
//
// shifts, pixels, coc_quanta, cells           as in patterns.cl; the first row of cells here is
//                                             row window_cells - 1 there
// variance     [rows of cells of the window][units][DEFRAY_PATTERN_UNIT]  V around each cell, of
//                                             8-bit colours
// behind_coc   [height][width]                radius of the synthesised fragment
// behind_inverse  [height][width]             its 1/depth
// channel0..3  [height][width]                linear colours of the frame
// channel_behind0..3  [height][width]         the fragment's: before, smooth
// Global size: (units, rows of cells of this launch).
#include "base/colour.clh"
#include "chain/patterns_shift.clh"

// Cells of a unit and those that its windows reach to the right.
#define COLUMNS 16

// What a shift's windows weigh, and their mean squared difference times that, a cell of a unit.
typedef struct {
  float4 w, square_w;
  int4 is_match;
} Agreement;

Agreement agreement_of(const DefrayPatternsParams p, const float frame_square, const uint4 squares,
                       const uint4 pairs) {
  // White is 255. Two thirds of a step squared more: rounding to 8 bits hides as much.
  const float4 d = (convert_float4(squares) + p.frame_pairs * frame_square) /
                       (convert_float4(pairs) + p.frame_pairs) +
                   0.65025f;
  const float4 q = 650.25f / d;
  const float4 q2 = q * q;
  const float4 w = q2 * q2 * q2;
  const Agreement agreement = {w, w * d, as_int4(pairs > (uint4)(0u))};
  return agreement;
}

// From the first cell on that its windows reach.
Agreement windows_of(const DefrayPatternsParams p, const float frame_square,
                     __global const uint* restrict cells, const uint stride) {
  const int n = p.window_cells;
  uint16 column_squares = 0u, column_pairs = 0u;
  for (int j = 1 - n; j < n; ++j) {
    const uint16 cell = vload16(0, cells + (uint)(j + n - 1) * stride);
    const uint weight = (uint)(n - abs(j));
    column_squares += weight * (cell & 0xffffffu);
    column_pairs += weight * (cell >> 24u);
  }
  uint squares[COLUMNS], pairs[COLUMNS];
  vstore16(column_squares, 0, squares);
  vstore16(column_pairs, 0, pairs);
  uint4 all_squares = 0u, all_pairs = 0u;
  for (int j = 1 - n; j < n; ++j) {
    const uint weight = (uint)(n - abs(j));
    all_squares += weight * vload4(0, squares + j + n - 1);
    all_pairs += weight * vload4(0, pairs + j + n - 1);
  }
  return agreement_of(p, frame_square, all_squares, all_pairs);
}

float16 of_cells(const float4 v) { return (float16)(v.xxxx, v.yyyy, v.zzzz, v.wwww); }

// A row of a unit's pixels: sums over shifts.
typedef struct {
  float16 channel[4], weight, square;
} MatchSums;

// A row's pixels that hide something, and its surfaces behind.
typedef struct {
  int16 is_behind, coc;
  float16 inverse;
} HiddenRow;

// Adds a shift's share to the pixels of a row that have a match.
void add_match(const DefrayPatternsParams p, const DefrayPatternShift shift,
               __global const int* restrict pixels, __global const int* restrict coc_quanta,
               CHANNEL_PARAMETERS(channel), CHANNEL_PARAMETERS(channel_behind),
               const Agreement agreement, const HiddenRow row, const int2 start, MatchSums* sums) {
  const Matches there = matches_of(p, shift, start, row.inverse);
  const uint16 known = words_at(pixels, there) & DEFRAY_PATTERN_KNOWN;
  const int16 close = are_close(p, ints_at(coc_quanta, there.places), row.coc);
  const int4 m = agreement.is_match;
  const int16 is_match =
      row.is_behind & (int16)(m.xxxx, m.yyyy, m.zzzz, m.wwww) & as_int16(known != 0u) & close;
  if (!any_lane(is_match)) return;
  const Places own = itself(p, start).places;
  const float16 w = of_cells(agreement.w);
#define ADD(sum, value) sum = select(sum, sum + (value), is_match)
#define ADD_CHANNEL(i) \
  ADD(sums->channel[i], w*(floats_at(channel##i, there.places) - floats_at(channel_behind##i, own)))
  ADD_CHANNEL(0);
  ADD_CHANNEL(1);
  ADD_CHANNEL(2);
  ADD_CHANNEL(3);
  ADD(sums->weight, w);
  ADD(sums->square, of_cells(agreement.square_w));
}

// Moves a row's colours of one channel behind.
void move_row(const DefrayPatternsParams p, __global float* channel_behind, const int2 start,
              const int16 is_moved, const float16 by) {
  const float16 old = floats_at(channel_behind, itself(p, start).places), now = old + by;
  store_floats(p.width, channel_behind, start, select(old, now, is_moved & isfinite(now)));
}

// Moves a row's colours towards its matches' mean; `v` is the variance around each pixel.
void move_to_matches(const DefrayPatternsParams p, const int2 start, const float16 v,
                     const MatchSums* sums, WRITTEN_CHANNELS(channel_behind)) {
  const float16 w = sums->weight, gain = 1.0f - sums->square / w / (2.0f * v);
  const int16 is_moved = (w > 0.0f) & (v > 0.0f) & (gain > 0.0f);
  if (!any_lane(is_moved)) return;
#define MOVE(i) \
  if (p.channels > i) move_row(p, channel_behind##i, start, is_moved, gain*(sums->channel[i] / w))
  MOVE(0);
  MOVE(1);
  MOVE(2);
  MOVE(3);
}

// What hides something of a unit's rows, from `start` down; false: nothing does.
bool find_hidden(const DefrayPatternsParams p, __global const int* restrict pixels,
                 __global const int* restrict behind_coc,
                 __global const float* restrict behind_inverse, const int2 start, HiddenRow* rows) {
  bool has_behind = false;
  for (int j = 0; j < DEFRAY_PATTERN_CELL; ++j) {
    const Matches own = itself(p, start + (int2)(0, j));
    rows[j].is_behind = as_int16((words_at(pixels, own) & DEFRAY_PATTERN_BEHIND) != 0u);
    rows[j].coc = ints_at(behind_coc, own.places);
    rows[j].inverse = floats_at(behind_inverse, own.places);
    has_behind |= any_lane(rows[j].is_behind);
  }
  return has_behind;
}

__kernel void patterns_match(
    const DefrayPatternsParams p, __global const DefrayPatternShift* restrict shifts,
    __global const int* restrict pixels, __global const int* restrict coc_quanta,
    __global const uint* restrict cells, __global const float* restrict variance,
    __global const int* restrict behind_coc, __global const float* restrict behind_inverse,
    CHANNEL_PARAMETERS(channel), WRITTEN_CHANNELS(channel_behind)) {
  const int units = ((int)p.width + RUN - 1) / RUN, margin = p.window_cells - 1;
  const int unit = (int)get_global_id(0), cell_row = (int)get_global_id(1);
  const int first = p.first_row + DEFRAY_PATTERN_CELL * (cell_row + margin);
  if (unit >= units || cell_row + 2 * margin >= (int)p.cell_rows) return;
  const int2 start = (int2)(unit * RUN, first);
  HiddenRow rows[DEFRAY_PATTERN_CELL];
  if (!find_hidden(p, pixels, behind_coc, behind_inverse, start, rows)) return;
  const MatchSums none = {{0.0f, 0.0f, 0.0f, 0.0f}, 0.0f, 0.0f};
  MatchSums sums[DEFRAY_PATTERN_CELL] = {none, none, none, none};

  const uint stride = (uint)(units + 2 * DEFRAY_PATTERN_MARGIN) * DEFRAY_PATTERN_UNIT;
  const uint column = (uint)((unit + DEFRAY_PATTERN_MARGIN) * DEFRAY_PATTERN_UNIT - margin);
  __global const uint* from = cells + (uint)cell_row * stride + column;
  for (uint i = 0; i < p.shift_count; ++i, from += p.cell_rows * stride) {
    const Agreement agreement = windows_of(p, shifts[i].frame_square, from, stride);
    if (!any(agreement.is_match)) continue;
    for (int j = 0; j < DEFRAY_PATTERN_CELL; ++j) {
      if (!any_lane(rows[j].is_behind)) continue;
      add_match(p, shifts[i], pixels, coc_quanta, CHANNELS(channel), CHANNELS(channel_behind),
                agreement, rows[j], start + (int2)(0, j), &sums[j]);
    }
  }

  const float16 v = of_cells(
      vload4(0, variance + (first / DEFRAY_PATTERN_CELL * units + unit) * DEFRAY_PATTERN_UNIT));
  for (int j = 0; j < DEFRAY_PATTERN_CELL; ++j) {
    move_to_matches(p, start + (int2)(0, j), v, &sums[j], CHANNELS(channel_behind));
  }
}
