// gather_aware: a Poisson-disk gather that knows depth. The samples of gather_literal, but spread
// as far as light can come from (gather_reach), and each weighed by whether it arrives:
//
// - a nearer surface's light covers the pixel if the sample's own CoC reaches it. Its share of the
//   pixel is (area a sample stands for) / (area of its disc);
// - the pixel's own surface, and what lies behind it, show through in proportion to the rest,
//   within the pixel's own CoC: a sharp pixel takes nothing from behind.
//
// The signed CoC orders surfaces as depth does. Surfaces count as nearer from half a pixel of CoC
// on, wholly from one and a half, so that slanted surfaces stay whole.
//
// coc_quanta  [window_rows][width]  signed radius, 1/256 px
// reach       [tiles_y][tiles_x]    of the frame: largest radius that matters to a tile, quanta
// samples, rotations, colour, out         as in gather_literal
// Samples are taken at whole pixels: no colour is mixed across an edge.
// Global size: (runs of DEFRAY_RUN pixels of a row, band_rows).
#include "methods/gather.clh"

// Whole pixels nearest to places of at most 2^22, halves to the even one.
int16 nearest_of(const float16 places) { return as_int16(places + 0x1.8p23f) - as_int(0x1.8p23f); }

// Share of a disc's border pixel at this distance from its centre.
float16 covers(const float16 radius, const float16 distance) {
  return clamp(radius + 0.5f - distance, (float16)(0.0f), (float16)(1.0f));
}

// Pixels that the disc of this radius with its soft border covers: its integral, at least a pixel.
float16 disc_area(const float16 radius) {
  return fmax(3.14159274f * (radius * radius + 0.0833333358f), (float16)(1.0f));
}

// What the pixels of a run gather: nearer surfaces, and their own with what lies behind.
typedef struct {
  float4 near_sum[RUN], base_sum[RUN];  // of differences to the pixel's own colour
  float16 near_weight, base_weight;
} Gathered;

// How a pixel's samples are shared out. Where near discs come from far beyond the pixel's own,
// every second pair of samples stays within its own: else too few would be left for it.
typedef struct {
  float16 search, own_coc, own_radius;
  int16 splits;
  float16 near_area, base_area;  // pixels, or parts of one, that one sample stands for
} Discs;

Discs discs_of(const uint sample_count, const float16 own_coc, const float search) {
  Discs d;
  d.search = search;
  d.own_coc = own_coc;
  d.own_radius = fabs(own_coc);
  d.splits = d.search * d.search > 2.0f * d.own_radius * d.own_radius;
  const uint base_count = (sample_count + 1u) / 4u * 2u;
  const float all = (float)max(sample_count, 1u);
  const float near_split = (float)max(sample_count - base_count, 1u);
  const float base_split = (float)max(base_count, 1u);
  d.near_area = disc_area(d.search) / select((float16)(all), (float16)(near_split), d.splits);
  d.base_area = disc_area(select(d.search, d.own_radius, d.splits)) /
                select((float16)(all), (float16)(base_split), d.splits);
  return d;
}

// Adds differences to the pixels' own colours, none where the share is 0, whatever the colour.
void add_colours(const float16 shares, const uint* source, __global const float4* restrict colour,
                 const float4* own, float4* sums) {
  if (!any_lane(shares > 0.0f)) return;
  float share[RUN];
  vstore16(shares, 0, share);
  for (int k = 0; k < RUN; ++k) {
    const float4 given = share[k] * (colour[source[k]] - own[k]);
    sums[k] += select((float4)(0.0f), given, (float4)(share[k]) > 0.0f);
  }
}

// Adds sample `i` of all pixels of the run.
void add_sample(const DefrayGatherParams p, const Discs d, const uint i, const float2 sample,
                const RunVectors turn, __global const int* restrict coc_quanta,
                __global const float4* restrict colour, const GatherRun run, const float4* own,
                Gathered* sums) {
  const uint odd = p.sample_count & 1u;  // an odd set begins with its centre, pairs follow
  const bool is_base_pair = (i + odd) / 2u & 1u;
  const int16 none = 0;
  const int16 only_base = is_base_pair ? d.splits : none,
              only_near = is_base_pair ? none : d.splits;
  const RunVectors offset = offsets_of(sample, turn, select(d.search, d.own_radius, only_base));
  const int16 away_x = nearest_of(offset.x), away_y = nearest_of(offset.y);
  const int16 at_x = clamp((int)run.x + RUN_LANES + away_x, (int16)(0), (int16)((int)p.width - 1));
  const int16 at_y = clamp((int)run.row + away_y, (int16)(0), (int16)((int)p.window_rows - 1));
  const uint16 from = as_uint16(at_y) * p.width + as_uint16(at_x);
  const float16 coc =
      convert_float16(GATHERED(int16, coc_quanta, from)) * (1.0f / 256.0f * p.radius_scale);
  uint source[RUN];
  vstore16(from, 0, source);
  const float16 dx = convert_float16(away_x), dy = convert_float16(away_y);
  const float16 distance = sqrt(dx * dx + dy * dy);
  const float16 nearer = clamp(d.own_coc - coc - 0.5f, (float16)(0.0f), (float16)(1.0f));
  const float16 near = nearer * covers(fabs(coc), distance) * d.near_area / disc_area(fabs(coc));
  const float16 base = (1.0f - nearer) * covers(d.own_radius, distance);
  const float16 near_share = select(near, (float16)(0.0f), only_base);
  const float16 base_share = select(base, (float16)(0.0f), only_near);
  sums->near_weight += near_share;
  sums->base_weight += base_share;
  add_colours(near_share, source, colour, own, sums->near_sum);
  add_colours(base_share, source, colour, own, sums->base_sum);
}

__kernel void gather_aware(const DefrayGatherParams p, __global const int* restrict coc_quanta,
                           __global const int* restrict reach,
                           __global const float2* restrict samples,
                           __global const float2* restrict rotations,
                           __global const float4* restrict colour, __global float4* restrict out) {
  const GatherRun run = gather_run(p);
  if (run.count <= 0) return;
  const uint tiles_x = (p.width + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE;
  const uint tile = run.y / DEFRAY_GATHER_TILE * tiles_x + run.x / DEFRAY_GATHER_TILE;
  const float search = (float)reach[tile] * (1.0f / 256.0f * p.radius_scale);
  if (!(search >= 0.5f)) {
    for (int i = 0; i < run.count; ++i) {
      out[run.target + (size_t)i] = colour[run.first + (size_t)i];
    }
    return;
  }
  const Discs discs = discs_of(p.sample_count, gather_radii(p, coc_quanta, run), search);
  const RunVectors turn = gather_turns(p, rotations, run);
  Gathered sums;
  float4 own[RUN];
  for (int i = 0; i < RUN; ++i) {
    own[i] = colour[run.first + (size_t)min(i, run.count - 1)];
    sums.near_sum[i] = sums.base_sum[i] = 0.0f;
  }
  sums.near_weight = 0.0f;
  sums.base_weight = 1.0f / fmax(discs.base_area, (float16)(1.0f));  // the pixel itself: one pixel
  for (uint i = 0; i < p.sample_count; ++i) {
    add_sample(p, discs, i, samples[i], turn, coc_quanta, colour, run, own, &sums);
  }
  // Together the near discs cover at most all of the pixel.
  float near_total[RUN], rest[RUN], base_weight[RUN];
  vstore16(fmax(sums.near_weight, (float16)(1.0f)), 0, near_total);
  vstore16(fmax(1.0f - sums.near_weight, (float16)(0.0f)), 0, rest);
  vstore16(sums.base_weight, 0, base_weight);
  for (int i = 0; i < run.count; ++i) {
    const float4 near_mean = sums.near_sum[i] / near_total[i];
    out[run.target + (size_t)i] =
        own[i] + (near_mean + rest[i] * (sums.base_sum[i] / base_weight[i]));
  }
}
