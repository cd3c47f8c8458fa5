// splat_resolve: splats, the nearest first -> pixels (Krivanek & Zara 2003, sections 6.3, 6.4).
//
// The paper keeps fragments in an A-buffer, merges those whose depth ranges overlap and composites
// what is left from front to back. Splats come here in the order of their centres' depths: one
// whose range begins beyond those of all before it begins a surface, and every other belongs to the
// last. So one surface at a time is all that a pixel keeps, whatever number of fragments it has.
//
// A surface's weights estimate how much of the pixel it covers; beyond 1 the nearest count, or, as
// the paper has it (`averages`), all of them, divided by their sum. Of surfaces behind the first
// `layers` nothing is seen.
//
// splats   [count]           in order; DEFRAY_SPLAT_TILE-tiles know theirs
// lines    at which splats that name them end
// first    [tile_count + 1]  where a tile's part of `list` begins
// list     splats that meet the tile, in order
// out0..3  [height][width]   premultiplied colour and alpha
// depth    [height][width]   of the first surface with any alpha, the mean of its fragments' by
//                            their alpha, +inf without one
// count    [height][width]   fragments, up to where nothing shines through any more; below 0 where
//                            a surface is left out
// A work-item: a square of a tile, of which splats of a few pixels fill more than of a row.
// Global size: (tile_count, squares of a tile).
#include "base/any.clh"
#include "splat_params.h"

#define SIDE DEFRAY_SPLAT_SQUARE

// A work-item's pixels.
typedef struct {
  int x, y;
  int16 column, row;
  float16 centre_x, centre_y;
} Square;

// What they have come to: layers and sums have four channels.
typedef struct {
  float16 weight, layer0, layer1, layer2, layer3;  // the surface that is being made
  float16 sum0, sum1, sum2, sum3;                  // those before it
  float16 layer_seen, layer_z;                     // its weights times alpha, and times depth
  float16 far, depth;
  int16 count, ended, opaque;  // of surfaces; opaque: of any more nothing is seen
  int16 spilled;               // -1: that is because of `layers`
} SplatSquare;

// e^-power for 0 <= power < 80, within 10^-6 of itself (2 10^-6 from 10 on): 2^whole times a
// polynomial of degree 5 for what is left.
INLINED float16 falloff(const float16 power) {
  const float rounding = 0x1.8p23f;  // added, it leaves no bits behind the point
  const float16 exponent = power * -1.44269504f;
  // By bits: relaxed arithmetic may take away what was added just now.
  const int16 whole = as_int16(exponent + rounding) - as_int(rounding);
  const float16 x = exponent - convert_float16(whole);  // -1/2 to 1/2
  // Pairs of terms, which do not wait for each other.
  const float16 x2 = x * x;
  const float16 low = 0.693147004f * x + 1.0f;
  const float16 middle = 0.0555073358f * x + 0.240222424f;
  const float16 high = 0.00132647273f * x + 0.00967151299f;
  const float16 mantissa = (high * x2 + middle) * x2 + low;
  return as_float16(as_int16(mantissa) + (whole << 23));
}

// Not fmax and fmin: what those owe to what is not a number takes three instructions instead of
// one.
INLINED float16 larger(const float16 a, const float16 b) { return a > b ? a : b; }
INLINED float16 smaller(const float16 a, const float16 b) { return a < b ? a : b; }

// Puts the surface behind those before it.
INLINED void end_layer(SplatSquare* r, const int16 where, const bool averages) {
  const float16 left = 1.0f - r->sum3;
  const float16 share = averages ? left / larger(r->weight, 1.0f) : left;
  r->sum0 = select(r->sum0, r->sum0 + share * r->layer0, where);
  r->sum1 = select(r->sum1, r->sum1 + share * r->layer1, where);
  r->sum2 = select(r->sum2, r->sum2 + share * r->layer2, where);
  r->sum3 = select(r->sum3, r->sum3 + share * r->layer3, where);
  const int16 is_first = where & (r->depth == INFINITY) & (r->layer_seen > 0.0f);
  r->depth = select(r->depth, r->layer_z / r->layer_seen, is_first);
  const float16 none = 0.0f;
  r->layer_seen = select(r->layer_seen, none, where);
  r->layer_z = select(r->layer_z, none, where);
  r->weight = select(r->weight, none, where);
  r->layer0 = select(r->layer0, none, where);
  r->layer1 = select(r->layer1, none, where);
  r->layer2 = select(r->layer2, none, where);
  r->layer3 = select(r->layer3, none, where);
  r->opaque |= where & (1.0f - r->sum3 < DEFRAY_SPLAT_OPAQUE);
}

// How much of a splat is on its side of all its ridges.
INLINED float16 before_ridges(__global const DefraySplatLine* lines, const float16 dx,
                              const float16 dy) {
  float16 left = 1.0f;
  for (int i = 0; i < DEFRAY_SPLAT_RIDGES; ++i) {
    left = smaller(left, larger(lines[i].at + lines[i].x * dx + lines[i].y * dy, lines[i].least));
  }
  return left;
}

// A splat's weight in each pixel; 0 beyond its cut-off.
INLINED float16 splat_weight(__global const DefraySplat* s, __global const DefraySplatLine* lines,
                             const float16 dx, const float16 dy, const DefraySplatTileParams p) {
  const float16 form = (s->conic_xx * dx + 2.0f * s->conic_xy * dy) * dx + s->conic_yy * dy * dy;
  const float16 leant = s->amplitude + s->lean_x * dx + s->lean_y * dy;
  float16 facing = larger(s->back * leant, leant);
  if (s->lines != 0) facing *= before_ridges(lines + s->lines * DEFRAY_SPLAT_RIDGES, dx, dy);
  if (s->disc_top > 0.0f) {
    const float16 left = smaller(larger(s->disc_top - form, 0.0f), 1.0f);
    return facing * (left * left * (1.0f + s->disc_bulge * (1.0f - left)));
  }
  const float16 inside = smaller(larger(form, 0.0f), p.cutoff);
  return select((float16)(0.0f), facing * larger(falloff(inside) - p.edge, 0.0f), form < p.cutoff);
}

// Most hit some pixel: a way out for those that do not costs more, guessed wrongly, than it saves.
INLINED void add_splat(SplatSquare* r, __global const DefraySplat* s, const float16 weight,
                       const DefraySplatTileParams p) {
  const int16 hits = (weight > 0.0f) & ~r->opaque;
  const int16 begins = hits & (s->z_near > r->far);
  int16 joins = hits;
  if (any_lane(begins)) {
    end_layer(r, begins, p.averages);
    r->ended -= begins;
    const int16 spills = begins & ~r->opaque & (r->ended > p.layers);
    r->spilled |= spills;
    r->opaque |= spills;
    joins &= ~r->opaque;
  }
  // Only where it joins: 0 times what is not finite is not 0.
  const float16 taken = p.averages ? weight : smaller(weight, 1.0f - r->weight);
  r->weight = select(r->weight, r->weight + taken, joins);
  r->layer0 = select(r->layer0, r->layer0 + taken * s->r, joins);
  r->layer1 = select(r->layer1, r->layer1 + taken * s->g, joins);
  r->layer2 = select(r->layer2, r->layer2 + taken * s->b, joins);
  r->layer3 = select(r->layer3, r->layer3 + taken * s->a, joins);
  r->far = select(r->far, larger(r->far, s->z_far), joins);
  // All of it, or what the nearest leave of slanted surfaces would lie nearer than they.
  const float16 seen = weight * s->a;
  r->layer_seen = select(r->layer_seen, r->layer_seen + seen, joins);
  r->layer_z = select(r->layer_z, r->layer_z + seen * s->z, joins);
  r->count -= joins;
}

// One branch: four are guessed wrongly four times as often.
INLINED bool meets(__global const DefraySplat* s, const Square* q) {
  return (q->y < s->end_y) & (s->first_y < q->y + SIDE) & (q->x < s->end_x) &
         (s->first_x < q->x + SIDE);
}

// Where in the list the next splat is that has pixels in a square.
INLINED uint next_in_square(__global const DefraySplat* splats, __global const uint* list, uint i,
                            const uint end, const Square* q) {
  while (i < end && !meets(splats + list[i], q)) ++i;
  return i;
}

// splat_weight in the pixels of a square that are the splat's.
INLINED float16 weight_in_square(__global const DefraySplat* s,
                                 __global const DefraySplatLine* lines, const Square* q,
                                 const DefraySplatTileParams p) {
  const int16 inside = (q->column >= s->first_x) & (q->column < s->end_x) & (q->row >= s->first_y) &
                       (q->row < s->end_y);
  const float16 weight = splat_weight(s, lines, q->centre_x - s->x, q->centre_y - s->y, p);
  return select((float16)(0.0f), weight, inside);
}

// Writes what of a square lies in the picture.
INLINED void store_square(const DefraySplatTileParams p, __global float* plane, const Square* q,
                          const float16 values) {
  __global float* const to = plane + (size_t)q->y * p.width + q->x;
  const int columns = (int)p.width - q->x, rows = (int)p.height - q->y;
  if (columns >= SIDE && rows >= SIDE) {
    vstore4(values.lo.lo, 0, to);
    vstore4(values.lo.hi, 0, to + p.width);
    vstore4(values.hi.lo, 0, to + 2 * (size_t)p.width);
    vstore4(values.hi.hi, 0, to + 3 * (size_t)p.width);
    return;
  }
  float pixels[SIDE * SIDE];
  vstore16(values, 0, pixels);
  for (int j = 0; j < min(SIDE, rows); ++j) {
    for (int i = 0; i < min(SIDE, columns); ++i) to[(size_t)j * p.width + i] = pixels[j * SIDE + i];
  }
}

__kernel void splat_resolve(const DefraySplatTileParams p, __global const DefraySplat* splats,
                            __global const DefraySplatLine* lines, __global const uint* first,
                            __global const uint* list, __global float* out0, __global float* out1,
                            __global float* out2, __global float* out3, __global float* depth,
                            __global float* count) {
  if (get_global_id(0) >= p.tile_count) return;
  const uint tile = p.first_tile + (uint)get_global_id(0), square = (uint)get_global_id(1);
  const uint across = DEFRAY_SPLAT_TILE / SIDE;
  Square q;
  q.x = (int)(tile % p.tiles_x * DEFRAY_SPLAT_TILE + square % across * SIDE);
  q.y = (int)(tile / p.tiles_x * DEFRAY_SPLAT_TILE + square / across * SIDE);
  if (q.x >= (int)p.width || q.y >= (int)p.height || square >= across * across) return;
  q.column = q.x + (int16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
  q.row = q.y + (int16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
  q.centre_x = convert_float16(q.column) + 0.5f;
  q.centre_y = convert_float16(q.row) + 0.5f;

  SplatSquare r;
  r.weight = r.layer0 = r.layer1 = r.layer2 = r.layer3 = 0.0f;
  r.sum0 = r.sum1 = r.sum2 = r.sum3 = 0.0f;
  r.layer_seen = r.layer_z = 0.0f;
  r.far = -INFINITY;
  r.depth = INFINITY;
  r.count = r.ended = r.opaque = r.spilled = 0;
  const uint end = first[get_global_id(0) + 1];
  uint i = next_in_square(splats, list, first[get_global_id(0)], end, &q);
  while (i < end && !all_lanes(r.opaque)) {
    // Two at a time: neither's weights wait for the other's.
    const uint j = next_in_square(splats, list, i + 1, end, &q);
    __global const DefraySplat* s = splats + list[i];
    __global const DefraySplat* next = splats + list[j < end ? j : i];
    const float16 weight = weight_in_square(s, lines, &q, p);
    const float16 next_weight = weight_in_square(next, lines, &q, p);
    add_splat(&r, s, weight, p);
    if (j >= end) break;
    add_splat(&r, next, next_weight, p);
    i = next_in_square(splats, list, j + 1, end, &q);
  }
  end_layer(&r, ~r.opaque, p.averages);

  store_square(p, out0, &q, r.sum0);
  store_square(p, out1, &q, r.sum1);
  store_square(p, out2, &q, r.sum2);
  store_square(p, out3, &q, r.sum3);
  store_square(p, depth, &q, r.depth);
  store_square(p, count, &q, convert_float16((r.count ^ r.spilled) - r.spilled));
}
