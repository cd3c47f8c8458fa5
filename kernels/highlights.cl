// highlights, highlights_add: small bright sources as smooth discs of the aperture's shape.
//
// A lens cell either sees a source at a pixel or not: far brighter than what is around, it shows as
// dots. `highlights` finds such fragments: brighter than DEFRAY_HIGHLIGHT times the median of 32
// pixels around the disc they will fill, those that were seen. What they have above that median
// goes to `highlights_add`, the median stays with the rays.
//
// `highlights_add` gives each pixel the share of a source's light that falls into its square: the
// light of a box of the aperture, from a summed-area table, in integers, so that the shares of all
// pixels add up to 1. Light arrives where the RDB's cells nearest to its way through the lens are
// not held by a surface in front.
//
// highlights:
// coc_quanta   [height][layers][width]  signed radius, 1/256 px
// coverage     [height][layers][width]  2^-16 of the pixel; 0: no fragment. What is made up is no
//                                       highlight.
// channel0..3  [height][layers][width]
// kept         [height][layers][width]  share of its colour that the fragment keeps, else 1
// Global size: (width, height x layers).
//
// highlights_add:
// first        [tiles + 1]        where a tile's list begins
// list                            highlights of each tile, in source order
// where        [highlights]       (x, y in the frame, coc in quanta, depth bits)
// excess       [highlights]       their light
// table        [side][side]       summed light of the aperture (host/aperture_table.h)
// cell_at      [side][side]       nearest lens cell, over the square around the lens
// winner, coc_quanta (window)     as in rdb_merge; all cells in one pass
// lens, rim_x, rim_y              as in rdb_merge; what the rim leaves counts as all light
// sum          [band_rows][width] in and out
// Global size: (width, band_rows).
#include "colour.h"
#include "frame.h"
#include "rim.h"

// The largest of the light channels: alpha is no light.
float light_of(const float4 c, const uint channels) {
  const float second = channels > 1u ? c.y : c.x, third = channels > 2u ? c.z : c.x;
  return fmax(fmax(c.x, second), fmax(third, channels > 3u ? c.w : c.x));
}

// Sample i of 32 around a fragment's disc: on its rim and half way, two pixels further out.
int2 around(const int2 at, const float radius, const uint i) {
  const float distance = fmax(radius, 3.0f) * (i < 16u ? 0.5f : 1.0f) + 2.0f;
  return at + convert_int2(rint(distance * sixteenth(i % 16u)));
}

__kernel void highlights(const DefrayHighlightParams p, __global const int* restrict coc_quanta,
                         __global const uint* restrict coverage,
                         __global const float* restrict channel0,
                         __global const float* restrict channel1,
                         __global const float* restrict channel2,
                         __global const float* restrict channel3, __global float* restrict kept) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.height * p.layers) return;
  const uint own = row * p.width + x;
  kept[own] = 1.0f;
  const uint share = coverage[own] < DEFRAY_SYNTHESISED ? coverage[own] : 0u;
  const float own_light =
      light_of(colour_at(channel0, channel1, channel2, channel3, own), p.light_channels);
  const int coc = coc_of(coc_quanta, own);
  if (share == 0u || coc == 0 || !(own_light > 0.0f) || isinf(own_light)) return;

  const int2 at = (int2)((int)x, (int)(row / p.layers));
  float light[32];
  uint count = 0u, dim = 0u;
  for (uint i = 0; i < 32u; ++i) {
    const int2 q = around(at, fabs((float)coc) * (1.0f / 256.0f), i);
    if (q.x < 0 || q.y < 0 || q.x >= (int)p.width || q.y >= (int)p.height) continue;
    const size_t front = (size_t)q.y * p.layers * p.width + (uint)q.x;
    if (coverage[front] >= DEFRAY_SYNTHESISED) continue;
    light[count] =
        light_of(colour_at(channel0, channel1, channel2, channel3, front), p.light_channels);
    dim += light[count] * DEFRAY_HIGHLIGHT < own_light ? 1u : 0u;
    ++count;
  }
  if (dim <= count / 2u) return;
  for (uint i = 0; i < count; ++i) {
    uint rank = 0u;
    for (uint k = 0; k < count; ++k) {
      rank += light[k] < light[i] || (light[k] == light[i] && k < i) ? 1u : 0u;
    }
    if (rank == count / 2u) kept[own] = fmax(light[i], 0.0f) / own_light;
  }
}

// The table's entry for a corner of a box, by four of its neighbours: exact (1/256 texel).
ulong light_before(__global const uint* restrict table, const long u, const long v) {
  const long most = 2L << DEFRAY_LENS_FRACTION_BITS;
  const uint x = (uint)clamp(u + (1L << DEFRAY_LENS_FRACTION_BITS), 0L, most);
  const uint y = (uint)clamp(v + (1L << DEFRAY_LENS_FRACTION_BITS), 0L, most);
  const uint column = x >> 8, row = y >> 8, last = DEFRAY_APERTURE_TABLE - 1u;
  const ulong right = x & 255u, below = y & 255u;
  const uint column1 = min(column + 1u, last), row1 = min(row + 1u, last);
  const ulong a = table[row * DEFRAY_APERTURE_TABLE + column];
  const ulong b = table[row * DEFRAY_APERTURE_TABLE + column1];
  const ulong c = table[row1 * DEFRAY_APERTURE_TABLE + column];
  const ulong d = table[row1 * DEFRAY_APERTURE_TABLE + column1];
  return (a * (256u - right) + b * right) * (256u - below) +
         (c * (256u - right) + d * right) * below;
}

// Lens coordinate of the border between pixels i and i + 1 to the right of a source.
long border(const int i, const int coc) { return (2L * i + 1L) * (1L << 23) / coc; }

// Light of a source that falls into the pixel at this distance: of the table's total.
ulong light_at(__global const uint* restrict table, const int2 distance, const int coc) {
  const long left = border(distance.x - 1, coc), right = border(distance.x, coc);
  const long above = border(distance.y - 1, coc), below = border(distance.y, coc);
  const long u0 = min(left, right), u1 = max(left, right);
  const long v0 = min(above, below), v1 = max(above, below);
  return light_before(table, u1, v1) + light_before(table, u0, v0) - light_before(table, u0, v1) -
         light_before(table, u1, v0);
}

// Row or column of the map of lens cells.
int map_entry(const int eighths, const int coc) {
  const long lens = (long)eighths * (1L << 21) / (long)coc + (1L << DEFRAY_LENS_FRACTION_BITS);
  const long at = lens >> (DEFRAY_LENS_FRACTION_BITS + 1 - DEFRAY_CELL_MAP_BITS);
  return (int)(at < 0 ? 0 : at > DEFRAY_CELL_MAP - 1 ? DEFRAY_CELL_MAP - 1 : at);
}

// The lens cell nearest to the way from a source to a point of a pixel, in eighths of a pixel.
uint cell_between(__global const uint* restrict cell_at, const int2 eighths, const int coc) {
  return cell_at[map_entry(eighths.y, coc) * DEFRAY_CELL_MAP + map_entry(eighths.x, coc)];
}

// Share of a source's light at a pixel that passes the rim, whose edge is soft over a pixel.
float rim_share(const int2 distance, const int coc, const int rim_x, const int rim_y) {
  const float unit = 1.0f / 65536.0f, radius = (float)coc * (1.0f / 256.0f);
  const float x = (float)distance.x - radius * ((float)rim_x * unit);
  const float y = (float)distance.y - radius * ((float)rim_y * unit);
  return clamp(fabs(radius) + 0.5f - sqrt(x * x + y * y), 0.0f, 1.0f);
}

// Whether the RDB's cell on the way from a source to a target is held by a surface in front of it.
bool is_hidden(const uint2 held, __global const int* restrict coc_quanta, const int4 source) {
  return held.x != DEFRAY_EMPTY && held.y < (uint)source.w &&
         coc_of(coc_quanta, held.x) < source.z - DEFRAY_JUMP_QUANTA;
}

__kernel void highlights_add(
    const DefrayRdbParams p, const DefrayLightParams l, __global const uint* restrict first,
    __global const uint* restrict list, __global const int4* restrict where,
    __global const float4* restrict excess, __global const uint* restrict table,
    __global const uint* restrict cell_at, __global const uint2* restrict winner,
    __global const int* restrict coc_quanta, __global const int2* restrict lens,
    __global const int* restrict rim_x, __global const int* restrict rim_y,
    __global float4* restrict sum) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;
  const uint y = p.band_y + row;
  const size_t target = (size_t)row * p.width + x;
  const uint tile = y / DEFRAY_LIGHT_TILE * l.tiles_x + x / DEFRAY_LIGHT_TILE;
  uint open = 0u;
  for (uint cell = 0; p.has_rim && cell < p.all_cells; ++cell) {
    open += passes_rim(lens[cell], rim_x[x], rim_y[y]) ? 1u : 0u;
  }
  const size_t cells_apart = (size_t)p.band_rows * p.width;
  float4 light = 0.0f;
  for (uint i = first[tile]; i < first[tile + 1u]; ++i) {
    const int4 h = where[list[i]];
    const int2 distance = (int2)((int)x - h.x, (int)y - h.y);
    const ulong arrives = light_at(table, distance, h.z);
    if (arrives == 0ul) continue;
    // A pixel that is large beside the disc sees many cells.
    const int points = abs(h.z) < DEFRAY_WIDE_QUANTA ? 4 : 1;
    uint visible = 0u;
    for (int k = 0; k < points * points; ++k) {
      const int2 point = points == 4 ? 2 * (int2)(k % 4, k / 4) - 3 : (int2)(0, 0);
      const size_t cell = cell_between(cell_at, distance * 8 + point, h.z);
      visible += is_hidden(winner[cell * cells_apart + target], coc_quanta, h) ? 0u : 1u;
    }
    if (visible == 0u) continue;
    const float passes = p.has_rim ? rim_share(distance, h.z, rim_x[x], rim_y[y]) : 1.0f;
    const float seen = (float)visible / (float)(points * points);
    light += ((float)arrives * l.share_of_light * passes * seen) * excess[list[i]];
  }
  if (p.has_rim) light *= (float)p.all_cells / (float)max(open, 1u);
  sum[target] += light;
}
