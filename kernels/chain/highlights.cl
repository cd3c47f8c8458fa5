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
// Global size: (width, height x layers).
#include "base/colour.clh"
#include "base/run.clh"
#include "chain/rank.clh"

// The largest of the light channels: alpha is no light.
float light_of(const float4 c, const uint channels) {
  const float second = channels > 1u ? c.y : c.x, third = channels > 2u ? c.z : c.x;
  return fmax(fmax(c.x, second), fmax(third, channels > 3u ? c.w : c.x));
}

float16 light_at(const uint channels, CHANNEL_PARAMETERS(channel), const Places from) {
  float16 light = floats_at(channel0, from);
  if (channels > 1u) light = fmax(light, floats_at(channel1, from));
  if (channels > 2u) light = fmax(light, floats_at(channel2, from));
  if (channels > 3u) light = fmax(light, floats_at(channel3, from));
  return light;
}

// Sixteen samples at a distance from a fragment.
typedef struct {
  Places from;
  int16 counts;  // in the frame, and seen
} Ring;

Ring ring_around(const DefrayHighlightParams p, __global const uint* restrict coverage,
                 const int2 at, const float distance) {
  const float a = 0.923879533f, b = 0.707106781f, c = 0.382683432f;
  const float16 cosines = {1.0f, a, b, c, 0.0f, -c, -b, -a, -1.0f, -a, -b, -c, 0.0f, c, b, a};
  const float16 sines = {0.0f, c, b, a, 1.0f, a, b, c, 0.0f, -c, -b, -a, -1.0f, -a, -b, -c};
  const int16 x = at.x + nearest_px_of_run(distance * cosines);
  const int16 y = at.y + nearest_px_of_run(distance * sines);
  const int16 column = clamp(x, (int16)(0), (int16)((int)p.width - 1));
  const int16 row = clamp(y, (int16)(0), (int16)((int)p.height - 1));
  Ring ring;
  ring.from = places_at(p.width, column, row * (int)p.layers);
  const int16 is_seen = ints_at((__global const int*)coverage, ring.from) >= 0;  // bit 31: not
  ring.counts = (column == x) & (row == y) & is_seen;
  return ring;
}

// How many lanes are true.
uint count_lanes(const int16 v) {
  const int8 a = v.lo + v.hi;
  const int4 b = a.lo + a.hi;
  const int2 c = b.lo + b.hi;
  return (uint) - (c.x + c.y);
}

// Of a ring's samples, those that are not far darker.
uint bright_of(const Ring ring, const float16 light, const float own) {
  return count_lanes(ring.counts & ~(light * DEFRAY_HIGHLIGHT < own));
}

// Writes what counts of a ring's light.
void store_counting(const Ring ring, const float16 light, float* to) {
  float lights[RUN];
  int counts[RUN];
  vstore16(light, 0, lights);
  vstore16(ring.counts, 0, counts);
  for (int i = 0; i < RUN; ++i) {
    if (counts[i]) *to++ = lights[i];
  }
}

// The share of its light that a highlight before such surroundings keeps.
float kept_of(const float own, const float median) {
  const float of_whole = median / own;
  if (median * DEFRAY_HIGHLIGHT_WHOLE <= own) return of_whole;
  const float range = (DEFRAY_HIGHLIGHT_WHOLE - DEFRAY_HIGHLIGHT) * median;
  return 1.0f - (own - DEFRAY_HIGHLIGHT * median) / range * (1.0f - of_whole);
}

__kernel void highlights(const DefrayHighlightParams p, __global const int* restrict coc_quanta,
                         __global const uint* restrict coverage, CHANNEL_PARAMETERS(channel),
                         __global const float* restrict darkest, __global float* restrict kept) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.height * p.layers) return;
  const uint own = row * p.width + x;
  kept[own] = 1.0f;
  const uint share = coverage[own] < DEFRAY_SYNTHESISED ? coverage[own] : 0u;
  const float own_light = light_of(colour_at(CHANNELS(channel), own), p.light_channels);
  const int coc = coc_of(coc_quanta, own);
  if (share == 0u || coc == 0 || !(own_light > 0.0f) || isinf(own_light)) return;
  const int2 at = (int2)((int)x, (int)(row / p.layers));
  const int2 tile = at / DEFRAY_HIGHLIGHT_TILE;
  if (!(darkest[(uint)tile.y * p.tiles_x + (uint)tile.x] * DEFRAY_HIGHLIGHT < own_light)) return;

  // Half way to the disc's rim and on it, two pixels further out.
  const float rim = fmax(fabs((float)coc) * (1.0f / 256.0f), 3.0f);
  const Ring inner = ring_around(p, coverage, at, rim * 0.5f + 2.0f);
  const float16 inner_light = light_at(p.light_channels, CHANNELS(channel), inner.from);
  uint bright = bright_of(inner, inner_light, own_light);
  if (bright == 16u) return;  // of 32 at most: half are not dim, whatever comes
  const Ring outer = ring_around(p, coverage, at, rim + 2.0f);
  const float16 outer_light = light_at(p.light_channels, CHANNELS(channel), outer.from);
  bright += bright_of(outer, outer_light, own_light);
  const uint inner_count = count_lanes(inner.counts);
  const uint count = inner_count + count_lanes(outer.counts);
  if (count - bright <= count / 2u) return;
  float light[2 * RUN];
  store_counting(inner, inner_light, light);
  store_counting(outer, outer_light, light + inner_count);
  for (uint i = 0; i < count; ++i) {
    if (rank_of(light, count, i) == count / 2u)
      kept[own] = kept_of(own_light, fmax(light[i], 0.0f));
  }
}
