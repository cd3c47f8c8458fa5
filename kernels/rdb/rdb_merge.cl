// rdb_merge: the mean over the cells of each pixel's ray distribution buffer (Shinya 1994,
// section 4, step 5).
//
// Cells that no ray reached take the farthest of what is at the pixel and beside it, where anything
// lies behind, or else do not count. Where all cells have the pixel's own colour, as in focus, or
// there are none, that comes out bit for bit, not as a rounded mean; elsewhere colours are simply
// added: sums of differences to one of them would lose dark cells beside a bright one. The cells
// come in passes, and sums run over them in lens order whatever the passes: one result, bit for
// bit, for every band height and memory budget.
//
// winner          [cell_count][band_rows][width]   from rdb_scatter
// coc_quanta, depth_bits, coverage  [window_rows][layers][width]  as in rdb_scatter
// lens            [cells]                          u_k, 2^-16 of the aperture radius
// rim_x, rim_y    [width], [band_y + band_rows]    centre of the rim; if has_rim: cells that
//                                                  it cuts off do not count
// channel0..3     [window_rows][layers][width]     colour planes of the source window
// sum0..3         [band_rows][width]               colours' sums; after the last pass the means
// filled          [band_rows][width]               cells that a ray has reached so far; bit 16:
//                                                  whether a colour differs from the pixel's own
// seen            [band_rows][width]               cells won by what the picture shows
// Global size: (width, band_rows).
#include "base/colour.clh"
#include "rdb/rim.clh"
#include "rdb/span.clh"

// What shows through where no ray arrives: the farthest fragment of the pixel and those around it,
// by the least of the radii that it spans, where anything lies behind any of them. Windows reach
// one row beyond their band, and two more where there are spans: no band changes the answer.
uint farthest_behind(const DefrayRdbParams p, __global const int* restrict coc_quanta,
                     __global const uint* restrict depth_bits,
                     __global const uint* restrict coverage, const int2 target) {
  uint found = DEFRAY_EMPTY;
  int farthest = 0;
  if (p.layers < 2u || !p.has_coverage) return found;
  const int row = (int)(p.band_y - p.window_y) + target.y;
  const int end_y = min(row + 2, (int)p.window_rows), end_x = min(target.x + 3, (int)p.width);
  for (int layer = 1; layer >= 0; --layer) {
    if (layer == 0 && found == DEFRAY_EMPTY) break;
    for (int y = max(row - 1, 0); y < end_y; ++y) {
      for (int x = max(target.x - 2, 0); x < end_x; ++x) {
        const uint i = ((uint)y * p.layers + (uint)layer) * p.width + (uint)x;
        if (depth_bits[i] == DEFRAY_EMPTY || (coverage[i] & ~DEFRAY_SYNTHESISED) == 0u) continue;
        int radius = coc_quanta[i];
        if (p.has_spans) {
          const Fragments all = {coc_quanta, depth_bits, p.width, p.layers, p.window_rows};
          radius = span_of(all, (int3)(x, y, layer)).x;
        }
        if (found != DEFRAY_EMPTY && radius <= farthest) continue;
        found = i;
        farthest = radius;
      }
    }
  }
  return found;
}

__kernel void rdb_merge(const DefrayRdbParams p, __global const uint2* restrict winner,
                        __global const int* restrict coc_quanta,
                        __global const uint* restrict depth_bits,
                        __global const uint* restrict coverage, __global const int2* restrict lens,
                        __global const int* restrict rim_x, __global const int* restrict rim_y,
                        CHANNEL_PARAMETERS(channel), WRITTEN_CHANNELS(sum),
                        __global uint* restrict filled, __global uint* restrict seen) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;

  const size_t target = (size_t)row * p.width + x;
  const size_t cell_stride = (size_t)p.band_rows * p.width;
  const float4 own =
      colour_at(CHANNELS(channel), (size_t)(p.band_y - p.window_y + row) * p.layers * p.width + x);
  float4 total = p.is_first_pass ? (float4)(0.0f) : colour_at(CHANNELS(sum), target);
  const uint state = p.is_first_pass ? 0u : filled[target];
  uint count = state & 0xffffu;
  bool differs = state != count;
  uint seen_count = p.is_first_pass ? 0u : seen[target];

  const uint behind =
      farthest_behind(p, coc_quanta, depth_bits, coverage, (int2)((int)x, (int)row));

  for (uint cell = 0; cell < p.cell_count; ++cell) {
    const uint held = winner[cell * cell_stride + target].x;
    const uint s = held == DEFRAY_EMPTY ? behind : held;
    if (s == DEFRAY_EMPTY) continue;
    if (p.has_rim && !passes_rim(lens[p.first_cell + cell], rim_x[x], rim_y[p.band_y + row])) {
      continue;
    }
    const float4 colour = colour_at(CHANNELS(channel), s);
    differs |= any(as_int4(colour) != as_int4(own));
    total += colour;
    ++count;
    seen_count += p.has_coverage ? 1u - (coverage[s] >> 31) : 1u;
  }

  if (p.is_last_pass) total = differs ? total / (float)max(count, 1u) : own;
  set_colour(CHANNELS(sum), target, total);
  seen[target] = seen_count;
  filled[target] = count | (differs ? 1u << 16 : 0u);
}
