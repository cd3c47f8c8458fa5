// rdb_between: the rows of sparse tiles that no rays were found for.
//
// Where all light comes through circles of confusion many pixels wide, the picture changes little
// from row to row. rdb_gather finds rays for some rows of such tiles (sparse.clh); here each pixel
// between them becomes the mean of the pixels above and below, weighted by distance. Of two equal
// values it is that value, and of infinite ones infinite.
//
// sparsity     [tiles]              as in rdb_gather
// mean0..3     [band_rows][width]   in and out; the band begins and ends with whole tiles, or where
//                                   the picture does
// seen         [band_rows][width]   in and out, rounded
// Global size: (columns of the picture, band_rows).
#include "base/colour.clh"
#include "rdb/rays.clh"
#include "rdb/sparse.clh"

// Of two values, so far from the first to the second.
float mix_of(const float a, const float b, const float share) {
  return a == b ? a : a * (1.0f - share) + b * share;
}

__kernel void rdb_between(const DefrayRaysParams p, __global const uint* restrict sparsity,
                          WRITTEN_CHANNELS(mean), __global uint* seen) {
  const int x = (int)(p.band_x + get_global_id(0));
  const int row = (int)get_global_id(1), y = row + (int)p.band_y;
  if (x >= (int)p.band_end || row >= (int)p.band_rows) return;
  const uint tile_sparsity = sparsity[tile_at(p, x, y)];
  if (tile_sparsity == 0u) return;
  const int below = (y - (int)p.window_y) % rows_spanned(tile_sparsity);
  if (is_row_of(tile_sparsity, below)) return;
  int j = 0;
  while (row_of(tile_sparsity, j + 1) < below) ++j;
  const int first = row_of(tile_sparsity, j), rows = row_of(tile_sparsity, j + 1) - first;
  const int from = below - first;
  const size_t at = (size_t)row * p.width + (size_t)x;
  const size_t a = at - (size_t)from * p.width, b = a + (size_t)rows * p.width;
  // 2, 3 or 5 rows: a division would be rounded as the device likes.
  const float share = (float)from * (rows == 2 ? 1.0f / 2 : rows == 3 ? 1.0f / 3 : 1.0f / 5);
  mean0[at] = mix_of(mean0[a], mean0[b], share);
  mean1[at] = mix_of(mean1[a], mean1[b], share);
  mean2[at] = mix_of(mean2[a], mean2[b], share);
  mean3[at] = mix_of(mean3[a], mean3[b], share);
  const uint to_first = (uint)(rows - from), to_second = (uint)from;
  seen[at] = (seen[a] * to_first + seen[b] * to_second + (uint)rows / 2u) / (uint)rows;
}
