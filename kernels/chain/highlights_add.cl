// highlights_add: small bright sources as smooth discs of the aperture's shape.
//
// Each pixel gets the share of a source's light that falls into its square: the light of a box of
// the aperture, from a summed-area table, in integers, so that the shares of all pixels add up to
// 1. Where the lens's rim cuts the aperture, boxes are cut in strips that end at the rim. What is
// in front of a source hides what its map says (light_maps), what is in focus its share of the
// pixel.
//
// first        [tiles + 1]        where a tile's list begins
// list                            sources of each tile, in order
// where        [sources]          (x, y in the frame, coc in quanta, columns + 256 rows of pixels)
// excess       [sources]          light of each of their pixels
// table        [side][side]       summed light of the aperture (host/lens/aperture_table.h)
// coc_quanta, coverage (window)   as in rdb_merge
// rim_x, rim_y                    as in rdb_merge; what the rim leaves counts as all light
// maps         [sources]          as in light_maps
// seen                            from it
// sum0..3      [band_rows][width] in and out
// Global size: blocks of DEFRAY_RAY_RUN x DEFRAY_RAY_ROWS targets, or targets (lanes.clh). Bands
// begin with tiles: no block lies in two.
#include "base/colour.clh"
#include "chain/light_disc.clh"

// Adds what arrives in a row of a source's light to a block.
INLINED void add_light_row(const DefrayRdbParams p, const DefrayLightParams l, const Way* way,
                           const Disc* d, const float4 excess, Row* row, Block* b) {
  find_edges(p, way, b, d->source.z, row);
  find_visible(way, d, row);
  for (int k = 0; k < LANES; ++k) {
    if (row->arrives[k] == 0ul || row->visible[k] == 0.0f) continue;
    const float seen = row->visible[k] * row->past[k];
    b->light[row->y - b->y][k] += ((float)row->arrives[k] * l.share_of_light * seen) * excess;
  }
}

// Adds a source's light to a block.
INLINED void add_source(const DefrayRdbParams p, const DefrayLightParams l, const Way* way,
                        const int4 source, const int2 map, const float4 excess, Block* b) {
  Disc d;
  d.source = source;
  d.map = map;
  d.across = across(source);
  d.down = down(source);
  const int reach = disc_px(source.z), left = b->x - source.x;
  if (left - d.across >= reach || left + LANES <= -reach) return;
  const int first_y = max(b->y, source.y - reach);
  const int end_y = min(b->end_y, source.y + d.down + reach);
  if (first_y >= end_y) return;
  place_disc(left, &d);
  ulong before[ROWS + DEFRAY_LIGHT_GROUP][LANES];  // of borders, from the first row's upper one on
  for (int j = 0; j < end_y - first_y + d.down; ++j) {
    find_before(way, &d, border(first_y - source.y - d.down + j, source.z), before[j]);
  }
  for (int j = 0; j < end_y - first_y; ++j) {
    Row row;
    row.y = first_y + j;
    if (find_light(p, way, b, &d, before[j], before[j + d.down], &row)) {
      add_light_row(p, l, way, &d, excess, &row, b);
    }
  }
}

__kernel void highlights_add(
    const DefrayRdbParams p, const DefrayLightParams l, __global const uint* restrict first,
    __global const uint* restrict list, __global const int4* restrict where,
    __global const float4* restrict excess, __global const uint* restrict table,
    __global const int* restrict coc_quanta, __global const uint* restrict coverage,
    __global const int* restrict rim_x, __global const int* restrict rim_y,
    __global const int4* restrict maps, __global const uchar* restrict seen,
    WRITTEN_CHANNELS(sum)) {
  const Way way = {table, coc_quanta, coverage, rim_x, rim_y, seen};
  Block b;
  b.x = (int)get_global_id(0) * LANES;
  b.y = (int)(p.band_y + get_global_id(1) * ROWS);
  b.end_y = min(b.y + ROWS, (int)(p.band_y + p.band_rows));
  if (b.x >= (int)p.width || b.y >= b.end_y) return;
  for (int k = 0; k < LANES; ++k) b.column[k] = (uint)min(b.x + k, (int)p.width - 1);
  for (int j = 0; j < ROWS; ++j) {
    for (int k = 0; k < LANES; ++k) b.light[j][k] = 0.0f;
  }
  const uint tile = (uint)b.y / DEFRAY_LIGHT_TILE * l.tiles_x + (uint)b.x / DEFRAY_LIGHT_TILE;
  const uint begin = first[tile], end = first[tile + 1u];
  for (uint i = begin; i < end; ++i) {
    add_source(p, l, &way, where[list[i]], maps[list[i]].xy, excess[list[i]], &b);
  }
  for (int y = b.y; y < b.end_y; ++y) {
    for (int x = b.x; x < min(b.x + LANES, (int)p.width); ++x) {
      float4 light = b.light[y - b.y][x - b.x];
      if (p.has_rim && begin < end) {
        const long4 lens = (long4)(-LENS_RADIUS, -LENS_RADIUS, LENS_RADIUS, LENS_RADIUS);
        const ulong open = light_through(table, lens, (long2)(rim_x[x], rim_y[y]));
        light /= fmax((float)open * l.share_of_light, 1e-6f);
      }
      const size_t target = (size_t)(y - (int)p.band_y) * p.width + (uint)x;
      set_colour(CHANNELS(sum), target, colour_at(CHANNELS(sum), target) + light);
    }
  }
}
