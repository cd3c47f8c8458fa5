// light_maps: through which part of the lens a small bright source is seen.
//
// From a source at s, with the signed CoC radius C, light passes the lens at u (in its radii) to
// the target s + C u. What has the radius c < C, nearer, hides it if it is seen at s + (C - c) u:
// so the way over the picture from s in the direction of u, a pixel at a time, meets radii from C
// down, and what is met at its own radius hides. Between two pixels of one surface the radius may
// be passed, too. What covers its pixel in part hides that part. What is in focus hides in its own
// pixels alone, which highlights_add asks.
//
// A source's map has `side` squared squares over the square around the lens, row by row, each seen
// from its middle, or from the rim before it.
//
// where    [sources]                as in highlights_add
// maps     [sources]                (first entry, side, least CoC of what may hide it, 0); side 0:
// no
//                                   map, nothing hides it
// coc_quanta, coverage (window)     as in rdb_merge
// seen     [entries]                255: all of it
// Global size: (runs of LANES squares of the largest map, sources).
#include "base/frame.clh"
#include "base/lanes.clh"
#include "chain/light_place.clh"

// Ways over the picture, of squares beside each other: a pixel's step, radii that it passes.
typedef struct {
  float step_x[LANES], step_y[LANES], passed[LANES];
  int steps[LANES];
  float before[LANES], coc[LANES];  // of the last pixel: how far behind the light; its radius
  float seen[LANES];
} LightWays;

// From the middle of squares, `first` and on.
INLINED int begin_light_ways(const float coc, const float least, const int side, const int first,
                             LightWays* w) {
  const float rim = 1.0f + 4.0f / (float)side;  // nobody asks for what is beyond it
  int most = 0;
  for (int k = 0; k < LANES; ++k) {
    const int square = min(first + k, side * side - 1);
    float u = (float)(2 * (square % side) + 1 - side) / (float)side;
    float v = (float)(2 * (square / side) + 1 - side) / (float)side;
    const float away = sqrt(u * u + v * v);
    u /= fmax(away, 1.0f);
    v /= fmax(away, 1.0f);
    const float longer = fmax(fabs(u), fabs(v));
    w->step_x[k] = u / longer;
    w->step_y[k] = v / longer;
    w->passed[k] = 1.0f / longer;
    w->steps[k] = away > rim ? 0 : (int)((coc - least) * longer) + 1;
    w->before[k] = 1.0f;
    w->coc[k] = coc;
    w->seen[k] = 1.0f;
    most = max(most, w->steps[k]);
  }
  return most;
}

// The pixels that ways meet after so many steps; beyond the window they end.
INLINED void find_met(const DefrayLightMapParams p, const float2 from, const int step, LightWays* w,
                      uint* at) {
  for (int k = 0; k < LANES; ++k) {
    const int2 px = nearest_px(from + (float)step * (float2)(w->step_x[k], w->step_y[k]));
    const int y = px.y - (int)p.window_y;
    const int is_inside = (px.x >= 0) & (px.x < (int)p.width) & (y >= 0) & (y < (int)p.window_rows);
    w->steps[k] = is_inside ? w->steps[k] : 0;
    at[k] = is_inside ? (uint)y * p.layers * p.width + (uint)px.x : 0u;
  }
}

// Whether what ways meet hides the light, a flag each; whether any does.
INLINED int find_hiding(const float coc, const int step, const float* met, LightWays* w,
                        int* hits) {
  const float nearest = coc - PX(DEFRAY_JUMP_QUANTA);
  int any = 0;
  for (int k = 0; k < LANES; ++k) {
    const float behind = met[k] - (coc - (float)step * w->passed[k]);
    const int goes_on = fabs(met[k] - w->coc[k]) < 2.0f * PX(DEFRAY_JUMP_QUANTA);
    const int is_met =
        (fabs(behind) <= 0.5f * w->passed[k]) | ((w->before[k] < 0.0f) & (behind > 0.0f) & goes_on);
    hits[k] = is_met & (step <= w->steps[k]) & (met[k] < nearest) &
              (fabs(met[k]) >= PX(DEFRAY_SHARP_QUANTA));
    w->before[k] = behind;
    w->coc[k] = met[k];
    any |= hits[k];
  }
  return any;
}

__kernel void light_maps(const DefrayLightMapParams p, __global const int4* restrict where,
                         __global const int4* restrict maps,
                         __global const int* restrict coc_quanta,
                         __global const uint* restrict coverage, __global uchar* seen) {
  if (get_global_id(1) >= p.sources) return;
  const int4 source = where[get_global_id(1)];
  const int4 map = maps[get_global_id(1)];
  const int first = (int)get_global_id(0) * LANES;
  if (first >= map.y * map.y) return;
  const float coc = PX(source.z);
  const float2 from = middle_of(source);
  LightWays w;
  int most = begin_light_ways(coc, PX(map.z), map.y, first, &w);
  for (int step = 1; step <= most; ++step) {
    uint at[LANES];
    find_met(p, from, step, &w, at);
    float met[LANES];
    for (int k = 0; k < LANES; ++k) met[k] = PX(tame(coc_quanta[at[k]]));
    int hits[LANES];
    if (!find_hiding(coc, step, met, &w, hits)) continue;
    most = 0;
    for (int k = 0; k < LANES; ++k) {
      const uint share = p.has_coverage ? coverage[at[k]] & ~DEFRAY_SYNTHESISED : DEFRAY_WHOLE;
      const float left = 1.0f - (float)share * (1.0f / DEFRAY_WHOLE);
      w.seen[k] = hits[k] ? w.seen[k] * left : w.seen[k];
      w.steps[k] = w.seen[k] > 0.0f ? w.steps[k] : 0;
      most = max(most, w.steps[k]);
    }
  }
  for (int k = 0; k < LANES && first + k < map.y * map.y; ++k) {
    seen[map.x + first + k] = (uchar)(w.seen[k] * 255.0f + 0.5f);
  }
}
