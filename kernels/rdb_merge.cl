// rdb_merge: the mean over the cells of each pixel's ray distribution buffer (Shinya 1994,
// section 4, step 5).
//
// Cells that no ray reached take what lies behind the pixel or beside it, if anything, or else do
// not count; a pixel without any ray keeps its own colour. Where all cells have one colour, as in
// focus, it comes out bit for bit, not as a rounded mean; elsewhere colours are simply added: sums
// of differences to one of them would lose dark cells beside a bright one. The cells come in
// passes, and sums run over them in lens order whatever the passes: one result, bit for bit, for
// every band height and memory budget.
//
// winner          [cell_count][band_rows][width]   from rdb_scatter
// coverage, depth_bits  [window_rows][layers][width]  as in rdb_scatter
// lens            [cells]                          u_k, 2^-16 of the aperture radius
// rim_x, rim_y    [width], [band_y + band_rows]    centre of the rim; if has_rim: cells that
//                                                  it cuts off do not count
// channel0..3     [window_rows][layers][width]     colour planes of the source window
// sum             [band_rows][width]               colours' sums; after the last pass the means
// filled          [band_rows][width]               (x: cells that a ray has reached so far; bits 16
//                                                   to 19: whether each channel has varied,
//                                                   y: source of the first of them)
// seen            [band_rows][width]               cells won by what the picture shows
// Global size: (width, band_rows).
#include "colour.clh"
#include "rim.clh"

// What shows through where no ray arrives: the farthest fragment behind the pixel and those around
// it. Windows reach one row beyond their band: no band changes the answer.
uint farthest_behind(const DefrayRdbParams p, __global const uint* restrict coverage,
                     __global const uint* restrict depth_bits, const int2 target) {
  uint found = DEFRAY_EMPTY;
  if (p.layers < 2u || !p.has_coverage) return found;
  const int row = (int)(p.band_y - p.window_y) + target.y;
  for (int y = max(row - 1, 0); y <= min(row + 1, (int)p.window_rows - 1); ++y) {
    for (int x = max(target.x - 2, 0); x <= min(target.x + 2, (int)p.width - 1); ++x) {
      const uint i = ((uint)y * p.layers + 1u) * p.width + (uint)x;
      if (coverage[i] == 0u) continue;
      if (found == DEFRAY_EMPTY || depth_bits[i] > depth_bits[found]) found = i;
    }
  }
  return found;
}

__kernel void rdb_merge(const DefrayRdbParams p, __global const uint2* restrict winner,
                        __global const uint* restrict coverage,
                        __global const uint* restrict depth_bits,
                        __global const int2* restrict lens, __global const int* restrict rim_x,
                        __global const int* restrict rim_y, CHANNEL_PARAMETERS(channel),
                        __global float4* restrict sum, __global uint2* restrict filled,
                        __global uint* restrict seen) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;

  const size_t target = (size_t)row * p.width + x;
  const size_t own = (size_t)(p.band_y - p.window_y + row) * p.layers * p.width + x;
  const size_t cell_stride = (size_t)p.band_rows * p.width;
  float4 total = p.is_first_pass ? (float4)(0.0f) : sum[target];
  const uint2 state = p.is_first_pass ? (uint2)(0u, (uint)own) : filled[target];
  uint count = state.x & 0xffffu;
  uint seen_count = p.is_first_pass ? 0u : seen[target];
  uint f = state.y;  // the pixel itself while no ray has arrived
  float4 first = colour_at(CHANNELS(channel), f);
  int4 varies = (int4)((int)(state.x >> 16)) << (int4)(31, 30, 29, 28);  // in the sign bits

  const uint behind = farthest_behind(p, coverage, depth_bits, (int2)((int)x, (int)row));

  for (uint cell = 0; cell < p.cell_count; ++cell) {
    const uint held = winner[cell * cell_stride + target].x;
    const uint s = held == DEFRAY_EMPTY ? behind : held;
    if (s == DEFRAY_EMPTY) continue;
    if (p.has_rim && !passes_rim(lens[p.first_cell + cell], rim_x[x], rim_y[p.band_y + row])) {
      continue;
    }
    const float4 colour = colour_at(CHANNELS(channel), s);
    if (count == 0u) {
      f = s;
      first = colour;
    }
    if (s != f) varies |= colour != first;  // a NaN differs from itself
    total += colour;
    ++count;
    seen_count += p.has_coverage ? 1u - (coverage[s] >> 31) : 1u;
  }

  if (p.is_last_pass) total = select(first, total / (float)max(count, 1u), varies);
  sum[target] = total;
  seen[target] = seen_count;
  const uint4 flags = as_uint4(varies) >> (uint4)(31u);
  filled[target] =
      (uint2)(count | flags.x << 16 | flags.y << 17 | flags.z << 18 | flags.w << 19, f);
}
