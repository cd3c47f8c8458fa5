// gather_tiles, gather_reach: how far a pixel must look for light that may reach it.
//
// A pixel's own CoC says nothing about the near, wide ones that cover it. gather_tiles finds the
// largest |CoC| of each tile; gather_reach the largest among all tiles close enough to reach a tile
// (McGuire et al., "A reconstruction filter for plausible motion blur", 2012, for CoC).
//
// coc_quanta  [height][width]     signed radius, 1/256 px
// largest     [tiles_y][tiles_x]  quanta
// reach       [tiles_y][tiles_x]  quanta
// gather_reach runs twice, along x and then, on its own result, along y: squares dilate one axis at
// a time, and of the tiles of a row that reach a column the largest reaches farthest along it.
// Global size of both: (tiles_x, tiles_y). Integers only: the same on every device.
#include "methods_params.h"

__kernel void gather_tiles(const DefrayTileParams p, __global const int* restrict coc_quanta,
                           __global int* restrict largest) {
  const uint tile_x = get_global_id(0);
  const uint tile_y = get_global_id(1);
  if (tile_x >= p.tiles_x || tile_y >= p.tiles_y) return;
  const uint x0 = tile_x * DEFRAY_GATHER_TILE, y0 = tile_y * DEFRAY_GATHER_TILE;
  const uint x1 = min(x0 + DEFRAY_GATHER_TILE, p.width);
  const uint y1 = min(y0 + DEFRAY_GATHER_TILE, p.height);
  int most = 0;
  for (uint y = y0; y < y1; ++y) {
    for (uint x = x0; x < x1; ++x) {
      most = max(most, (int)abs(coc_quanta[(size_t)y * p.width + x]));
    }
  }
  largest[tile_y * p.tiles_x + tile_x] = most;
}

__kernel void gather_reach(const DefrayTileParams p, __global const int* restrict largest,
                           __global int* restrict reach) {
  const int tile_x = (int)get_global_id(0);
  const int tile_y = (int)get_global_id(1);
  if (tile_x >= (int)p.tiles_x || tile_y >= (int)p.tiles_y) return;
  const int here = p.along_y ? tile_y : tile_x;
  const int tiles = (int)(p.along_y ? p.tiles_y : p.tiles_x);
  const int step = p.along_y ? (int)p.tiles_x : 1;
  const int line = tile_y * (int)p.tiles_x + tile_x - here * step;
  const int last = min(here + p.reach_tiles, tiles - 1);
  int most = 0;
  for (int i = max(here - p.reach_tiles, 0); i <= last; ++i) {
    // Pixel centres of different tiles are at least this far apart, in px.
    const int gap = max((int)abs(i - here) - 1, 0) * DEFRAY_GATHER_TILE;
    const int theirs = largest[line + i * step];
    if ((long)gap << DEFRAY_COC_FRACTION_BITS <= theirs) most = max(most, theirs);
  }
  reach[line + here * step] = most;
}
