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
// coc_quanta  [height][width]                 signed radius, 1/256 px
// reach       [tiles_y][tiles_x]              largest radius that matters to a tile, quanta
// samples, rotations, channel0..3, out        as in gather_literal
// Samples are taken at whole pixels: no colour is mixed across an edge.
#include "frame.clh"
#include "gather.clh"

// Share of a disc's border pixel at this distance from its centre.
float covers(const float radius, const float distance) {
  return clamp(radius + 0.5f - distance, 0.0f, 1.0f);
}

// Pixels that the disc of this radius with its soft border covers: its integral, at least a pixel.
float disc_area(const float radius) {
  return fmax(3.14159274f * (radius * radius + 0.0833333358f), 1.0f);
}

// Pixels, or parts of one, that one of so many samples over a disc stands for.
float pixels_a_sample(const float radius, const uint count) {
  return disc_area(radius) / (float)max(count, 1u);
}

__kernel void gather_aware(const DefrayGatherParams p, __global const int* restrict coc_quanta,
                           __global const int* restrict reach,
                           __global const float2* restrict samples,
                           __global const float2* restrict rotations, CHANNEL_PARAMETERS(channel),
                           __global float4* restrict out) {
  const uint x = get_global_id(0);
  const uint row = get_global_id(1);
  if (x >= p.width || row >= p.band_rows) return;
  const uint y = p.band_y + row;
  const size_t target = (size_t)row * p.width + x;
  const size_t own_at = (size_t)y * p.width + x;
  const float quantum = (1.0f / 256.0f) * p.radius_scale;
  const float4 own = colour_at(CHANNELS(channel), own_at);
  const float own_coc = (float)coc_quanta[own_at] * quantum;
  const uint tiles_x = (p.width + DEFRAY_GATHER_TILE - 1) / DEFRAY_GATHER_TILE;
  const uint tile = y / DEFRAY_GATHER_TILE * tiles_x + x / DEFRAY_GATHER_TILE;
  const float search = (float)reach[tile] * quantum;
  const float2 turn = gather_turn(p, rotations, x, y);
  // Where near discs come from far beyond the pixel's own, every second pair of samples stays
  // within its own: else too few would be left for it.
  const float own_radius = fabs(own_coc);
  const bool splits = search * search > 2.0f * own_radius * own_radius;
  const uint odd = p.sample_count & 1u;  // an odd set begins with its centre, pairs follow
  const uint base_count = splits ? (p.sample_count + 1u) / 4u * 2u : p.sample_count;
  const uint near_count = splits ? p.sample_count - base_count : p.sample_count;
  const float near_area = pixels_a_sample(search, near_count);
  const float base_area = pixels_a_sample(splits ? own_radius : search, base_count);

  float4 near_sum = 0.0f, base_sum = 0.0f;  // of differences to the pixel's own colour
  float near_weight = 0.0f,
        base_weight = 1.0f / fmax(base_area, 1.0f);  // the pixel itself: one pixel
  for (uint i = 0; i < p.sample_count && search >= 0.5f; ++i) {
    const bool only_base = splits && ((i + odd) / 2u & 1u);
    const bool only_near = splits && !only_base;
    const int2 away = nearest_px((only_base ? own_radius : search) * rotated(samples[i], turn));
    const float2 offset = convert_float2(away);
    const int2 at =
        clamp((int2)((int)x, (int)y) + away, 0, (int2)((int)p.width - 1, (int)p.height - 1));
    const size_t source = (size_t)at.y * p.width + (uint)at.x;
    const float coc = (float)coc_quanta[source] * quantum;
    const float distance = sqrt(offset.x * offset.x + offset.y * offset.y);
    const float nearer = clamp(own_coc - coc - 0.5f, 0.0f, 1.0f);
    const float4 c = colour_at(CHANNELS(channel), source) - own;
    const float near = nearer * covers(fabs(coc), distance) * near_area / disc_area(fabs(coc));
    const float base = (1.0f - nearer) * covers(own_radius, distance);
    const float near_share = only_base ? 0.0f : near, base_share = only_near ? 0.0f : base;
    near_sum += near_share > 0.0f ? near_share * c : (float4)(0.0f);
    base_sum += base_share > 0.0f ? base_share * c : (float4)(0.0f);
    near_weight += near_share;
    base_weight += base_share;
  }
  // Together the near discs cover at most all of the pixel.
  const float4 near_mean = near_sum / fmax(near_weight, 1.0f);
  const float rest = fmax(1.0f - near_weight, 0.0f);
  out[target] = search >= 0.5f ? own + (near_mean + rest * (base_sum / base_weight)) : own;
}
