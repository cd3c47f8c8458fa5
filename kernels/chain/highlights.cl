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
#include "base/frame.clh"
#include "chain/rank.clh"

// The largest of the light channels: alpha is no light.
float light_of(const float4 c, const uint channels) {
  const float second = channels > 1u ? c.y : c.x, third = channels > 2u ? c.z : c.x;
  return fmax(fmax(c.x, second), fmax(third, channels > 3u ? c.w : c.x));
}

// Sample i of 32 around a fragment's disc: on its rim and half way, two pixels further out.
int2 around(const int2 at, const float radius, const uint i) {
  const float distance = fmax(radius, 3.0f) * (i < 16u ? 0.5f : 1.0f) + 2.0f;
  return at + nearest_px(distance * sixteenth(i % 16u));
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

  float light[32];
  uint count = 0u, dim = 0u;
  for (uint i = 0; i < 32u; ++i) {
    const int2 q = around(at, fabs((float)coc) * (1.0f / 256.0f), i);
    if (!is_inside(p.width, p.height, q)) continue;
    const size_t front = (size_t)q.y * p.layers * p.width + (uint)q.x;
    if (coverage[front] >= DEFRAY_SYNTHESISED) continue;
    light[count] = light_of(colour_at(CHANNELS(channel), front), p.light_channels);
    dim += light[count] * DEFRAY_HIGHLIGHT < own_light ? 1u : 0u;
    ++count;
    if (count - dim == 16u) return;  // of 32 at most: half are not dim, whatever comes
  }
  if (dim <= count / 2u) return;
  for (uint i = 0; i < count; ++i) {
    if (rank_of(light, count, i) == count / 2u)
      kept[own] = kept_of(own_light, fmax(light[i], 0.0f));
  }
}
