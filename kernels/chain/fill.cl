// fill: what lies behind the surfaces in front, as far as the lens can uncover it.
//
// From each pixel rays go out over the picture in 8 or 16 directions until they leave its surface
// over a jump in CoC and meet a farther one, close enough for the lens to look there past the edge:
// closer than the step in CoC. The found pixels that lie on one surface (find_surface),
// continued along their slant, give CoC and depth: both are linear in the picture for a plane
// (depth as 1/z), and weighed alike. Their colours are weighed by how little each changes further
// on along its ray: stripes go on behind in their direction; and by how much more it changes across
// the ray than along it, most of all where the opposite ray has found the same: lines and edges go
// on behind (coherence transport, Bornemann & Maerz 2007). Highlights do not smear: a colour far
// brighter than those further on gives way to them, one far brighter than the median of all does
// not count.
//
// coc_quanta   [height][width]    signed radius, 1/256 px
// inverse      [height][width]    1/depth; 0: background
// marks        [height][width]    DEFRAY_MIXED: nothing is found there, as their colour is two
//                                 surfaces' (kernel `mixed`), or what they show is thin;
//                                 DEFRAY_SILHOUETTE: one goes on there
//                                 (host/chain/silhouettes/silhouettes.h)
// pure_around  [cells_y][cells_x] so many pixels around those of a run that begins in the cell none
//                                 is marked
// farthest     [tiles_y][tiles_x] the largest signed radius that the tile's pixels can meet;
//                                 DEFRAY_NOTHING_BEHIND: none behind them
// channel0..3  [height][width]
// behind_coc   [height][width]    signed radius; as given where nothing was found
// behind_inverse [height][width]  1/depth; negative where nothing was found
// behind0..3   [height][width]    colour
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "chain/fill_walk.clh"

float2 direction_of(const DefrayFillParams p, const uint i) {
  return sixteenth(i * (DEFRAY_FILL_DIRECTIONS / p.directions));
}

// 1/depth in front of a run's pixels: of a mixed one, that of the nearest surface around it.
float16 own_inverse_of_run(const Window* w, const int2 start) {
  const float16 own = inverse_of_run(w, start);
  const int16 is_pure = pure_of_run(w, start);
  if (all_lanes(is_pure)) return own;
  float16 nearest = own;
  for (int i = 0; i < 9; ++i) {
    const float16 inverse = inverse_of_run(w, start + (int2)(i % 3 - 1, i / 3 - 1));
    nearest = select(nearest, inverse, inverse > nearest);
  }
  return select(nearest, own, is_pure);
}

// Whether a CoC radius may be of the surface of another.
int16 is_of(const float16 coc, const float16 surface, const float16 own) {
  return fabs(coc - surface) <= DEFRAY_JUMP_QUANTA + 0.125f * (surface - own);
}

// Whether what was found may be of one surface, where it is continued to or where it was met.
int16 are_alike(const Found* a, const Found* b, const float16 own) {
  return is_of(b->coc, a->coc, own) | is_of(b->met, a->met, own);
}

// What lies beyond a silhouette is left out, where anything was found on this side of it. Returns
// in how many directions.
int16 leave_barred_out(Found* found, const uint directions) {
  int16 is_free = 0, left_out = 0;
  for (uint i = 0; i < directions; ++i) {
    is_free |= (found[i].distance != 0.0f) & ~found[i].is_barred;
  }
  for (uint i = 0; i < directions; ++i) {
    const int16 goes = is_free & (found[i].distance != 0.0f) & found[i].is_barred;
    found[i].distance = select(found[i].distance, (float16)(0.0f), goes);
    left_out -= goes;
  }
  return left_out;
}

// For which pixels of a run anything was found; the CoC of the nearest.
int16 find_nearest(const Found* found, const uint directions, Found* nearest) {
  int16 is_found = 0;
  nearest->distance = nearest->coc = nearest->met = 0.0f;
  for (uint i = 0; i < directions; ++i) {
    const float16 distance = found[i].distance;
    const int16 is_nearer = (distance != 0.0f) & (~is_found | (distance < nearest->distance));
    nearest->distance = select(nearest->distance, distance, is_nearer);
    nearest->coc = select(nearest->coc, found[i].coc, is_nearer);
    nearest->met = select(nearest->met, found[i].met, is_nearer);
    is_found |= is_nearer;
  }
  return is_found;
}

// The CoC of the surface that lies behind pixels of a run: that of the nearest. Where something was
// found all around, in three quarters of the directions, it is the one that most of it is on, so
// that silhouettes go on from one side to the other (by the nearest they ended in a step half way);
// directions count by 1 / distance, as in mean value coordinates (Floater 2003). Where less was
// found, past one edge, what is thin would end there.
int16 find_surface(const Found* found, const uint directions, const float16 own,
                   const int16 left_out, float16* coc) {
  Found best;
  const int16 is_found = find_nearest(found, directions, &best);
  int16 is_other = 0, count = left_out;
  for (uint i = 0; i < directions; ++i) {
    const int16 is_there = found[i].distance != 0.0f;
    count -= is_there;
    is_other |= is_there & ~are_alike(&best, found + i, own);
  }
  *coc = best.coc;
  const int16 is_open = is_other & (4 * count >= (int16)(3 * (int)directions));
  if (!any_lane(is_open)) return is_found;
  const float16 none = 0.0f;
  float16 most = none;
  for (uint i = 0; i < directions; ++i) {
    const float16 distance = found[i].distance;
    if (!any_lane(distance != 0.0f)) continue;
    float16 around = none;
    for (uint j = 0; j < directions; ++j) {
      const int16 counts = (found[j].distance != 0.0f) & are_alike(found + i, found + j, own);
      around += select(none, 1.0f / found[j].distance, counts);
    }
    const int16 is_nearer = (around == most) & (distance < best.distance);
    const int16 is_more = is_open & (distance != 0.0f) & ((around > most) | is_nearer);
    most = select(most, around, is_more);
    best.distance = select(best.distance, distance, is_more);
    *coc = select(*coc, found[i].coc, is_more);
  }
  return is_found;
}

// The upper median of how bright those are that count; equal ones in their order.
float16 median_of(const Found* found, const int16* counts, const uint directions) {
  int16 count = 0;
  for (uint i = 0; i < directions; ++i) count -= counts[i];
  float16 median = 0.0f;
  for (uint i = 0; i < directions; ++i) {
    if (!any_lane(counts[i])) continue;
    const float16 bright = found[i].bright;
    int16 rank = 0;
    for (uint k = 0; k < directions; ++k) {
      const float16 other = found[k].bright;
      const int16 is_before = k < i ? other <= bright : other < bright;
      rank -= counts[k] & is_before;
    }
    median = select(median, bright, counts[i] & (rank == count / 2));
  }
  return median;
}

// So much more a colour counts whose surface is coherent along the way, and where it goes on in the
// opposite direction. (0.3 and 3, 1 and 10, 1 and 0: built-in scenes of 640x400 within 0.06 dB.)
#define STRUCTURE 0.3f
#define STRUCTURE_GOES_ON 10.0f

// By how much a line or an edge goes on from one of opposite directions to the other: both
// coherent, and as alike as what lies beside them is not.
float16 going_on(const Found* a, const Found* b) {
  const float16 none = 0.0f, sides = fmin(a->sides, b->sides);
  const float16 apart = sum_of_squares(a->colours.c0 - b->colours.c0, a->colours.c1 - b->colours.c1,
                                       a->colours.c2 - b->colours.c2);
  const float16 alike = select(none, 1.0f - apart / sides, apart < sides);
  return STRUCTURE_GOES_ON * fmin(a->coherence, b->coherence) * alike;
}

void weigh_structures(Found* found, const int16* counts, const uint directions) {
  const uint turn = directions / 2u;
  for (uint i = 0; i < turn; ++i) {
    Found* const a = found + i;
    Found* const b = found + i + turn;
    const int16 both = counts[i] & counts[i + turn];
    float16 on = 0.0f;
    if (any_lane(both)) on = select(on, going_on(a, b), both);
    if (any_lane(counts[i])) a->weight *= 1.0f + STRUCTURE * a->coherence + on;
    if (any_lane(counts[i + turn])) b->weight *= 1.0f + STRUCTURE * b->coherence + on;
  }
}

// What lies behind a run's pixels.
typedef struct {
  int16 is_there, coc;
  float16 inverse;
  Colours colours;
} Filled;

// The mean of what was found on one surface alone: others' colours say nothing about its
// highlights.
Filled fill_run(const DefrayFillParams p, const Window* w, const int2 start, Found* found,
                const int16 own, const float16 own_inverse, const int16 left_out) {
  const uint directions = p.directions;
  Filled behind;
  const float16 own_coc = convert_float16(own);
  float16 surface;
  behind.is_there = find_surface(found, directions, own_coc, left_out, &surface);
  int16 counts[DEFRAY_FILL_DIRECTIONS];
  for (uint i = 0; i < directions; ++i) {
    counts[i] = (found[i].distance != 0.0f) & is_of(found[i].coc, surface, own_coc);
    if (any_lane(counts[i])) note_colours(w, start, direction_of(p, i), counts[i], found + i);
  }
  weigh_structures(found, counts, directions);
  const float16 brightest = 10.0f * median_of(found, counts, directions), none = 0.0f;
  float16 weights = 0.0f, coc = 0.0f, inverse = 0.0f, colour_weights = 0.0f;
  Colours sum = {0.0f, 0.0f, 0.0f, 0.0f};
  for (uint i = 0; i < directions; ++i) {
    if (!any_lane(counts[i])) continue;
    const Found f = found[i];
    const float16 weight = select(none, 1.0f / (f.distance * f.distance), counts[i]);
    weights += weight;
    coc += select(none, weight * f.coc, counts[i]);
    inverse += select(none, weight * f.inverse, counts[i]);
    const int16 shows = counts[i] & ~(f.bright > brightest);
    colour_weights += select(none, f.weight, shows);
    sum.c0 += select(none, f.weight * f.colours.c0, shows);
    sum.c1 += select(none, f.weight * f.colours.c1, shows);
    sum.c2 += select(none, f.weight * f.colours.c2, shows);
    sum.c3 += select(none, f.weight * f.colours.c3, shows);
  }
  behind.coc = convert_int16_rte(select(none, coc / weights, behind.is_there));
  const float16 mean = inverse / weights, most = own_inverse * 0.99999f;
  behind.inverse = select(most, mean, mean < most);
  behind.colours.c0 = sum.c0 / colour_weights;
  behind.colours.c1 = sum.c1 / colour_weights;
  behind.colours.c2 = sum.c2 / colour_weights;
  behind.colours.c3 = sum.c3 / colour_weights;
  return behind;
}

// Writes what lies behind a run's pixels: where nothing does, their own CoC and no colour.
void write_behind(const Window* w, const int2 start, const Filled* b,
                  __global int* restrict behind_coc, __global float* restrict behind_inverse,
                  WRITTEN_CHANNELS(behind)) {
  const int16 own = ints_of_run(w->width, w->height, w->coc_quanta, start);
  const int16 coc = (b->coc & b->is_there) | (own & ~b->is_there);
  const float16 none = 0.0f, nothing = -1.0f;
  store_ints(w->width, behind_coc, start, coc);
  store_floats(w->width, behind_inverse, start, select(nothing, b->inverse, b->is_there));
  store_floats(w->width, behind0, start, select(none, b->colours.c0, b->is_there));
  store_floats(w->width, behind1, start, select(none, b->colours.c1, b->is_there));
  store_floats(w->width, behind2, start, select(none, b->colours.c2, b->is_there));
  store_floats(w->width, behind3, start, select(none, b->colours.c3, b->is_there));
}

__kernel void fill(const DefrayFillParams p, __global const int* restrict coc_quanta,
                   __global const float* restrict inverse, __global const uint* restrict marks,
                   __global const uchar* restrict pure_around,
                   __global const int* restrict farthest, CHANNEL_PARAMETERS(channel),
                   __global int* restrict behind_coc, __global float* restrict behind_inverse,
                   WRITTEN_CHANNELS(behind)) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  const Window w = {p.width,     p.height, coc_quanta, inverse,  marks,
                    pure_around, channel0, channel1,   channel2, channel3};
  const uint tile = (uint)start.y / DEFRAY_FILL_TILE * p.tiles_x + (uint)start.x / DEFRAY_FILL_TILE;
  Filled behind;
  behind.is_there = 0;
  if (farthest[tile] != DEFRAY_NOTHING_BEHIND) {
    const int16 own = own_of_run(&w, start);
    Found found[DEFRAY_FILL_DIRECTIONS];
    for (uint i = 0; i < p.directions; ++i) {
      look_behind(&w, start, direction_of(p, i), own, farthest[tile], found + i);
    }
    const int16 left_out = leave_barred_out(found, p.directions);
    behind = fill_run(p, &w, start, found, own, own_inverse_of_run(&w, start), left_out);
  }
  write_behind(&w, start, &behind, behind_coc, behind_inverse, CHANNELS(behind));
}
