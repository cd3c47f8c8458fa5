// highlights_add: small bright sources as smooth discs of the aperture's shape.
//
// Each pixel gets the share of a source's light that falls into its square: the light of a box of
// the aperture, from a summed-area table, in integers, so that the shares of all pixels add up to
// 1. Where the lens's rim cuts the aperture, boxes are cut in strips that end at the rim. Light
// arrives where the RDB's cells nearest to its way through the lens are not held by a surface in
// front: means over nine of them, so that what hides a part of a disc has no teeth, and what covers
// its pixels in part no dots. A sharp edge's share of a pixel holds some
// cells and others not: of light behind it that share is taken, whichever cells are nearest.
//
// first        [tiles + 1]        where a tile's list begins
// list                            highlights of each tile, in source order
// where        [highlights]       (x, y in the frame, coc in quanta, 0)
// excess       [highlights]       their light
// table        [side][side]       summed light of the aperture (host/lens/aperture_table.h)
// cell_at      [side][side]       nearest lens point, over the square around the lens
// winner                          as in rdb_nearest; all cells in one pass
// coc_quanta, coverage (window)   as in rdb_merge
// rim_x, rim_y                    as in rdb_merge; what the rim leaves counts as all light
// sum0..3      [band_rows][width] in and out
// Global size: (width, band_rows).
#include "base/colour.clh"
#include "base/frame.clh"

#define LENS_RADIUS (1L << DEFRAY_LENS_FRACTION_BITS)

// The table's entry for a point in the square around the lens, by four of its neighbours: exact
// (1/256 texel).
ulong light_before(__global const uint* restrict table, const long u, const long v) {
  const uint x = (uint)(u + LENS_RADIUS), y = (uint)(v + LENS_RADIUS);
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

// Whether a pixel so far from a source along one axis lies beyond its disc: `border` of both sides
// is beyond the lens.
bool misses(const int distance, const int coc) {
  return (2L * (long)abs(distance) - 1L) * 128L >= (long)abs(coc);
}

// The part of the lens that a source's light passes on its way to a pixel: (left, top, right,
// bottom), limited to the square around the lens.
long4 box_between(const int2 distance, const int coc) {
  const long2 a = (long2)(border(distance.x - 1, coc), border(distance.y - 1, coc));
  const long2 b = (long2)(border(distance.x, coc), border(distance.y, coc));
  const long2 least = (long2)(-LENS_RADIUS), most = (long2)(LENS_RADIUS);
  return (long4)(clamp(min(a, b), least, most), clamp(max(a, b), least, most));
}

// Light within a box, of the table's total.
ulong light_in(__global const uint* restrict table, const long4 box) {
  return light_before(table, box.z, box.w) + light_before(table, box.x, box.y) -
         light_before(table, box.x, box.w) - light_before(table, box.z, box.y);
}

// Half a chord of the rim's circle at a distance from its centre: rounded down, on any device.
long half_chord(const long away) {
  const long square = LENS_RADIUS * LENS_RADIUS - away * away;
  const long near = (long)sqrt((float)square);
  return near * near > square ? near - 1L : (near + 1L) * (near + 1L) <= square ? near + 1L : near;
}

// Light within a box that passes the rim, by strips each as wide as in its middle: 16 to a pixel,
// more where that is large beside the lens.
ulong light_through(__global const uint* restrict table, const long4 box, const long2 rim) {
  if (box.x >= box.z || box.y >= box.w) return 0ul;
  const long2 far = max(rim - box.xy, box.zw - rim);
  if (far.x * far.x + far.y * far.y <= LENS_RADIUS * LENS_RADIUS) return light_in(table, box);
  const long top = max(box.y, rim.y - LENS_RADIUS), bottom = min(box.w, rim.y + LENS_RADIUS);
  const long strips = 16L + (bottom - top) * 32L / LENS_RADIUS;
  ulong light = 0ul;
  for (long k = 0; k < strips && top < bottom; ++k) {
    const long above = top + (bottom - top) * k / strips;
    const long below = top + (bottom - top) * (k + 1L) / strips;
    const long reach = half_chord((above + below) / 2L - rim.y);
    const long left = max(box.x, rim.x - reach), right = min(box.z, rim.x + reach);
    if (left < right) light += light_in(table, (long4)(left, above, right, below));
  }
  return light;
}

// Row or column of the map of lens points.
int map_entry(const int eighths, const int coc) {
  const long lens = (long)eighths * (1L << 21) / (long)coc + LENS_RADIUS;
  const long at = lens >> (DEFRAY_LENS_FRACTION_BITS + 1 - DEFRAY_CELL_MAP_BITS);
  return (int)(at < 0 ? 0 : at > DEFRAY_CELL_MAP - 1 ? DEFRAY_CELL_MAP - 1 : at);
}

// Whether the RDB's cell on the way from a source to a target is held by a surface in front of it.
bool is_hidden(const uint held, __global const int* restrict coc_quanta, const int4 source) {
  return held != DEFRAY_EMPTY && coc_of(coc_quanta, held) < source.z - DEFRAY_JUMP_QUANTA;
}

// How much of a source is seen from a target, by the cells nearest to its way through the lens: a
// pixel that is large beside the disc sees those of 16 places in it, another those around one,
// weighed 1 2 1 along both axes. Cells that a surface `not_hiding` holds are free.
uint visible_of_16(const DefrayRdbParams p, const DefrayLightParams l,
                   __global const uint* restrict cell_at, __global const uint* restrict winner,
                   __global const int* restrict coc_quanta, const int4 source, const int2 distance,
                   const uint not_hiding) {
  const bool is_wide = abs(source.z) >= DEFRAY_WIDE_QUANTA;
  const int spread = (int)((long)abs(source.z) * l.spread >> 21);
  const int count = is_wide ? 3 : 4;
  int columns[4], rows[4];
  for (int i = 0; i < count; ++i) {
    const int eighths = is_wide ? spread * (i - 1) : 2 * i - 3;
    columns[i] = map_entry(distance.x * 8 + eighths, source.z);
    rows[i] = map_entry(distance.y * 8 + eighths, source.z);
  }
  const size_t cells_apart = (size_t)p.band_rows * p.width * p.winner_words;
  uint visible = 0u;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const uint held = winner[cell_at[rows[j] * DEFRAY_CELL_MAP + columns[i]] * cells_apart];
      const bool is_free = held == not_hiding || !is_hidden(held, coc_quanta, source);
      const uint weight = is_wide ? (1u + (i == 1 ? 1u : 0u)) * (1u + (j == 1 ? 1u : 0u)) : 1u;
      visible += is_free ? weight : 0u;
    }
  }
  return visible;
}

__kernel void highlights_add(
    const DefrayRdbParams p, const DefrayLightParams l, __global const uint* restrict first,
    __global const uint* restrict list, __global const int4* restrict where,
    __global const float4* restrict excess, __global const uint* restrict table,
    __global const uint* restrict cell_at, __global const uint* restrict winner,
    __global const int* restrict coc_quanta, __global const uint* restrict coverage,
    __global const int* restrict rim_x, __global const int* restrict rim_y, WRITTEN_CHANNELS(sum)) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;
  const uint y = p.band_y + row;
  const size_t target = (size_t)row * p.width + x;
  const uint tile = y / DEFRAY_LIGHT_TILE * l.tiles_x + x / DEFRAY_LIGHT_TILE;
  const long2 rim = p.has_rim ? (long2)(rim_x[x], rim_y[y]) : (long2)(0L);
  const uint own = (p.band_y - p.window_y + row) * p.layers * p.width + x;
  const int own_coc = coc_of(coc_quanta, own);
  const bool is_sharp_edge = p.has_coverage && coverage[own] < DEFRAY_WHOLE && coverage[own] > 0u &&
                             abs(own_coc) < DEFRAY_SHARP_QUANTA;
  float4 light = 0.0f;
  for (uint i = first[tile]; i < first[tile + 1u]; ++i) {
    const int4 h = where[list[i]];
    const int2 distance = (int2)((int)x - h.x, (int)y - h.y);
    if (misses(distance.x, h.z) || misses(distance.y, h.z)) continue;
    const long4 box = box_between(distance, h.z);
    const ulong arrives = p.has_rim ? light_through(table, box, rim) : light_in(table, box);
    if (arrives == 0ul) continue;
    const bool is_veiled = is_sharp_edge && own_coc < h.z - DEFRAY_JUMP_QUANTA;
    const uint visible = visible_of_16(p, l, cell_at, winner + target * p.winner_words, coc_quanta,
                                       h, distance, is_veiled ? own : DEFRAY_EMPTY);
    if (visible == 0u) continue;
    const float past = is_veiled ? 1.0f - (float)coverage[own] * (1.0f / DEFRAY_WHOLE) : 1.0f;
    const float seen = (float)visible * 0.0625f * past;
    light += ((float)arrives * l.share_of_light * seen) * excess[list[i]];
  }
  if (p.has_rim && first[tile] < first[tile + 1u]) {
    const long4 lens = (long4)(-LENS_RADIUS, -LENS_RADIUS, LENS_RADIUS, LENS_RADIUS);
    const ulong open = light_through(table, lens, rim);
    light /= fmax((float)open * l.share_of_light, 1e-6f);
  }
  set_colour(CHANNELS(sum), target, colour_at(CHANNELS(sum), target) + light);
}
