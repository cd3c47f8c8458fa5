// rdb_merge: the mean over the cells of each pixel's ray distribution buffer (Shinya 1994,
// section 4, step 5).
//
// Cells that no ray reached do not count; a pixel without any ray keeps its own colour. The mean is
// taken of the differences to the first cell's colour: equal colours, as in focus, come out bit for
// bit. The cells come in passes, and sums run over them in lens order whatever the passes: one
// result, bit for bit, for every band height and memory budget.
//
// winner          [cell_count][band_rows][width]   from rdb_scatter
// channel0..3     [window_rows][width]             colour planes of the source window
// sum             [band_rows][width]               differences' sums; after the last pass the means
// filled          [band_rows][width]               (x: cells that a ray has reached so far,
//                                                   y: source of the first of them)
// Global size: (width, band_rows).
#include "colour.h"
#include "params.h"

__kernel void rdb_merge(const DefrayRdbParams p, __global const uint2* restrict winner,
                        __global const float* restrict channel0,
                        __global const float* restrict channel1,
                        __global const float* restrict channel2,
                        __global const float* restrict channel3, __global float4* restrict sum,
                        __global uint2* restrict filled) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;

  const size_t target = (size_t)row * p.width + x;
  const size_t own = (size_t)(p.band_y - p.window_y + row) * p.width + x;
  const size_t cell_stride = (size_t)p.band_rows * p.width;
  float4 total = p.is_first_pass ? (float4)(0.0f) : sum[target];
  uint2 state = p.is_first_pass ? (uint2)(0u, (uint)own) : filled[target];

  for (uint cell = 0; cell < p.cell_count; ++cell) {
    const uint s = winner[cell * cell_stride + target].x;
    if (s == DEFRAY_EMPTY) continue;
    if (state.x == 0u) state.y = s;
    const uint f = state.y;
    if (s != f) {  // inf - inf would be NaN
      total += colour_at(channel0, channel1, channel2, channel3, s) -
               colour_at(channel0, channel1, channel2, channel3, f);
    }
    ++state.x;
  }

  if (p.is_last_pass) {
    const uint f = state.y;  // the pixel itself where no ray has arrived
    const float4 first = colour_at(channel0, channel1, channel2, channel3, f);
    const float4 mean = first + total / (float)max(state.x, 1u);
    total = select(mean, first, total == 0.0f);  // -0 + 0 would be +0
  }
  sum[target] = total;
  filled[target] = state;
}
