// highlights: finds small bright sources.
//
// A lens point either sees a source at a pixel or not: far brighter than what is around, it shows
// as dots. This finds such fragments: brighter than DEFRAY_HIGHLIGHT times the median of 32 pixels
// around the disc they will fill, those that were seen. What they have above that median, from
// DEFRAY_HIGHLIGHT_WHOLE times on all of it, goes to `highlights_add`, the rest stays with the
// rays.
//
// coc_quanta   [height][layers][width]  signed radius, 1/256 px
// coverage     [height][layers][width]  2^-16 of the pixel; 0: no fragment. What is made up is no
//                                       highlight.
// channel0..3  [height][layers][width]
// darkest      [tiles_y][tiles_x]  the least light that the fragments of a tile can look at
// kept         [height][layers][width]  share of its colour that the fragment keeps, else 1
// Global size: (runs of DEFRAY_RUN fragments of a row, height x layers).
#include "base/colour.clh"
#include "base/run.clh"
#include "chain/rank.clh"

#if DEFRAY_HIGHLIGHT_TILE != DEFRAY_RUN
#error "a run lies in one tile"
#endif

// The picture that surrounds a fragment: where it ends, and what of it is seen.
typedef struct {
  uint width, height, layers, light_channels;
  __global const uint* coverage;
  __global const float *channel0, *channel1, *channel2, *channel3;
} Surroundings;

// The largest of the light channels: alpha is no light.
float light_of(const float4 c, const uint channels) {
  const float second = channels > 1u ? c.y : c.x, third = channels > 2u ? c.z : c.x;
  return fmax(fmax(c.x, second), fmax(third, channels > 3u ? c.w : c.x));
}

// The same of sixteen.
INLINED float16 lights_at(const Surroundings* s, const Places at) {
  float16 light = floats_at(s->channel0, at);
  if (s->light_channels > 1u) light = fmax(light, floats_at(s->channel1, at));
  if (s->light_channels > 2u) light = fmax(light, floats_at(s->channel2, at));
  if (s->light_channels > 3u) light = fmax(light, floats_at(s->channel3, at));
  return light;
}

// How far away sample i of 32 around a fragment's disc lies: on its rim and half way, two pixels
// further out.
float distance_of(const float radius, const uint i) {
  return fmax(radius, 3.0f) * (i < 16u ? 0.5f : 1.0f) + 2.0f;
}

// Which of a run are so much brighter than what surrounds them: than more than half of it.
INLINED int16 before_dim(const Surroundings* s, const int2 at, const float16 radius,
                         const float16 own_light, const int16 asked) {
  const int16 x = (int16)(at.x) + RUN_LANES;
  int16 may = asked, count = 0, dim = 0;
  for (uint i = 0; i < 32u; ++i) {
    const float2 direction = sixteenth(i % 16u);
    const float16 distance = fmax(radius, (float16)(3.0f)) * (i < 16u ? 0.5f : 1.0f) + 2.0f;
    const int16 column = x + nearest_px_of_run(distance * direction.x);
    const int16 row = at.y + nearest_px_of_run(distance * direction.y);
    const int16 is_in =
        (column >= 0) & (row >= 0) & (column < (int)s->width) & (row < (int)s->height);
    const Places q =
        places_at(s->width, clamp(column, (int16)(0), (int16)((int)s->width - 1)),
                  clamp(row, (int16)(0), (int16)((int)s->height - 1)) * (int)s->layers);
    const int16 is_seen = is_in & (ints_at((__global const int*)s->coverage, q) >= 0);
    count -= is_seen;
    dim -= is_seen & (lights_at(s, q) * DEFRAY_HIGHLIGHT < own_light);
    may &= count - dim < 16;  // of 32 at most: half are not dim, whatever comes
    if (!any_lane(may)) return may;
  }
  return may & (dim > count / 2);
}

// The share of its light that a highlight before such surroundings keeps.
float kept_of(const float own, const float median) {
  const float of_whole = median / own;
  if (median * DEFRAY_HIGHLIGHT_WHOLE <= own) return of_whole;
  const float range = (DEFRAY_HIGHLIGHT_WHOLE - DEFRAY_HIGHLIGHT) * median;
  return 1.0f - (own - DEFRAY_HIGHLIGHT * median) / range * (1.0f - of_whole);
}

// That of one: a highlight.
float kept_at(const Surroundings* s, const int2 at, const float radius, const float own_light) {
  float light[32];
  uint count = 0u;
  for (uint i = 0; i < 32u; ++i) {
    const int2 q = at + nearest_px(distance_of(radius, i) * sixteenth(i % 16u));
    if (!is_inside(s->width, s->height, q)) continue;
    const size_t front = (size_t)q.y * s->layers * s->width + (uint)q.x;
    if (s->coverage[front] >= DEFRAY_SYNTHESISED) continue;
    const float4 colour = colour_at(s->channel0, s->channel1, s->channel2, s->channel3, front);
    light[count++] = light_of(colour, s->light_channels);
  }
  float kept = 1.0f;
  for (uint i = 0; i < count; ++i) {
    if (rank_of(light, count, i) == count / 2u) kept = kept_of(own_light, fmax(light[i], 0.0f));
  }
  return kept;
}

__kernel void highlights(const DefrayHighlightParams p, __global const int* restrict coc_quanta,
                         __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                         __global const float* restrict darkest, __global float* restrict kept) {
  const int2 start = run_start();
  const uint rows = p.height * p.layers;
  if (!is_inside(p.width, rows, start)) return;
  store_floats(p.width, kept, start, (float16)(1.0f));
  const Surroundings s = {p.width,  p.height, p.layers, p.light_channels, coverage,
                          channel0, channel1, channel2, channel3};
  const int2 at = (int2)(start.x, start.y / (int)p.layers), tile = at / DEFRAY_HIGHLIGHT_TILE;
  const float dark = darkest[(uint)tile.y * p.tiles_x + (uint)tile.x];
  const int16 x = (int16)(start.x) + RUN_LANES;
  const Places own = places_at(p.width, min(x, (int16)((int)p.width - 1)), (int16)(start.y));
  const float16 own_light = lights_at(&s, own);
  const int16 coc = coc_of_run(p.width, rows, coc_quanta, start);
  const int16 is_seen = ints_at((__global const int*)coverage, own) > 0;
  const float16 radius = fabs(convert_float16(coc)) * (1.0f / 256.0f);
  int16 is_bright = is_seen & (coc != 0) & (own_light > 0.0f) & ~isinf(own_light);
  is_bright &= (x < (int)p.width) & (dark * DEFRAY_HIGHLIGHT < own_light);
  if (!any_lane(is_bright)) return;
  is_bright = before_dim(&s, at, radius, own_light, is_bright);
  if (!any_lane(is_bright)) return;
  int is_one[RUN];
  float lights[RUN], radii[RUN];
  vstore16(is_bright, 0, is_one);
  vstore16(own_light, 0, lights);
  vstore16(radius, 0, radii);
  for (int i = 0; i < run_length(p.width, start); ++i) {
    if (!is_one[i]) continue;
    kept[(size_t)start.y * p.width + (uint)(start.x + i)] =
        kept_at(&s, at + (int2)(i, 0), radii[i], lights[i]);
  }
}
