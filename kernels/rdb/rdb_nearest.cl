// rdb_nearest: the nearest fragment that a pixel's rays meet, for channels that cannot be averaged.
//
// Of all cells' winners the one of the smallest radius of its own; equal ones go to the smaller
// source index. Fragments without data of their own do not count, nor do cells that the rim cuts
// off. The cells come in passes: the minimum runs on over them, the same for every band height and
// memory budget.
//
// winner          [cell_count][band_rows][width][winner_words]  from rdb_scatter or rdb_gather
// coc_quanta      [window_rows][layers][width]     as in rdb_scatter
// data_of         [window_rows][layers][width]     all ones: no data; if has_data_of, else all have
// lens            [cells]                          u_k, 2^-16 of the aperture radius
// rim_x, rim_y    [width], [band_y + band_rows]    centre of the rim; if has_rim
// nearest         [band_rows][width]               (x: source index in the window, y: key),
//                                                  all ones where there is none
// Global size: (width, band_rows).
#include "rdb/rim.clh"

__kernel void rdb_nearest(const DefrayRdbParams p, __global const uint* restrict winner,
                          __global const int* restrict coc_quanta,
                          __global const uint* restrict data_of, __global const int2* restrict lens,
                          __global const int* restrict rim_x, __global const int* restrict rim_y,
                          __global uint2* restrict nearest) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;

  const size_t target = (size_t)row * p.width + x;
  const size_t cell_stride = (size_t)p.band_rows * p.width;
  uint2 best = p.is_first_pass ? (uint2)(DEFRAY_EMPTY) : nearest[target];
  for (uint k = 0; k < p.cell_count; ++k) {
    const uint held = winner[(k * cell_stride + target) * p.winner_words];
    if (held == DEFRAY_EMPTY) continue;
    const uint2 w = (uint2)(held, as_uint(coc_quanta[held]) ^ 0x80000000u);
    const bool is_nearer = w.y < best.y || (w.y == best.y && w.x < best.x);
    if (!is_nearer || (p.has_data_of && data_of[w.x] == DEFRAY_EMPTY)) continue;
    if (p.has_rim && !passes_rim(lens[p.first_cell + k], rim_x[x], rim_y[p.band_y + row])) {
      continue;
    }
    best = w;
  }
  nearest[target] = best;
}
