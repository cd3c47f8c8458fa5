// fill: what lies behind the surfaces in front, as far as the lens can uncover it.
//
// From each pixel rays go out over the picture in 8 or 16 directions until they leave its surface
// over a jump in CoC and meet a farther one, close enough for the lens to look there past the edge:
// closer than the step in CoC. The found pixels that lie on the surface of the nearest, continued
// along their slant, give CoC and depth: both are linear in the picture for a plane (depth as 1/z),
// and weighed alike. Their colours are weighed by how little each changes further on along its ray:
// stripes go on behind in their direction. Highlights do not smear: a colour far brighter than
// those further on gives way to them, one far brighter than the median of all does not count.
//
// coc_quanta   [height][width]    signed radius, 1/256 px
// inverse      [height][width]    1/depth; 0: background
// mixed        [height][width]    from kernel `mixed`: their colour is two surfaces'
// farthest     [tiles_y][tiles_x] the largest signed radius that the tile's pixels can meet;
//                                 DEFRAY_NOTHING_BEHIND: none behind them
// channel0..3  [height][width]
// behind_coc   [height][width]    signed radius; as given where nothing was found
// behind_inverse [height][width]  1/depth; negative where nothing was found
// behind0..3   [height][width]    colour
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "colour.clh"
#include "fill_walk.clh"
#include "rank.clh"

// What a ray over the picture has found.
typedef struct {
  uint source;
  float distance;  // in pixels; 0: nothing
  float coc;       // quanta, and
  float inverse;   // 1/depth: continued to where the ray began
  float weight;    // of its colour
} Found;

// CoC and depth of the surface at q, continued back along the ray. Its slant is taken from four
// pixels further on, if they are still the same surface; the result keeps half the step. Places are
// whole pixels: the way back is measured along the line from q to that pixel.
Found continue_back(const DefrayFillParams p, __global const int* restrict coc_quanta,
                    __global const float* restrict inverse, __global const uint* restrict mixed,
                    const int2 start, const float2 direction, const int t, const int own) {
  const int2 back = nearest_px((float)t * direction);
  const int2 on = nearest_px(4.0f * direction);
  const int2 beyond = start + back + on;
  const uint q = pixel_at(p.width, p.height, start + back);
  Found found = {q, (float)t, (float)coc_of(coc_quanta, q), inverse[q], 0.0f};
  if (!is_inside(p.width, p.height, beyond)) return found;
  const uint b = pixel_at(p.width, p.height, beyond);
  const float slant = (float)(coc_of(coc_quanta, q) - coc_of(coc_quanta, b));
  const float most = 0.5f * (float)(coc_of(coc_quanta, q) - own);
  if (mixed[b] || fabs(slant) > 4.0f * DEFRAY_JUMP_QUANTA) return found;
  const float steps = (float)(back.x * on.x + back.y * on.y) / (float)(on.x * on.x + on.y * on.y);
  const float change = slant * steps;
  const float kept = clamp(change, -most, most);
  const float share = change != 0.0f ? kept / change : 0.0f;
  found.coc += kept;
  const float continued = found.inverse + (inverse[q] - inverse[b]) * steps * share;
  found.inverse = continued > 0.0f ? continued : 0.0f;
  return found;
}

float2 direction_of(const DefrayFillParams p, const uint i) {
  return sixteenth(i * (DEFRAY_FILL_DIRECTIONS / p.directions));
}

// How far from black, for the median: NaN counts as the brightest.
float brightness(const float4 c) {
  const float sum = fabs(c.x + c.y + c.z);
  return isnan(sum) ? INFINITY : sum;
}

// Without alpha.
float sum_of_squares(const float4 c) {
  const float4 s = c * c;
  return s.x + s.y + s.z;
}

// The found colour's weight: looks at four pixels further on, each four pixels from the last, if
// they are still the same surface. A small highlight gives its place to the brightest of them,
// unless it lies so close to the edge that it may well go on behind it.
Found look_further(const DefrayFillParams p, __global const int* restrict coc_quanta,
                   __global const uint* restrict mixed, CHANNEL_PARAMETERS(channel),
                   const int2 start, const float2 direction, Found found) {
  const int coc = coc_of(coc_quanta, found.source);
  const float4 colour = colour_at(CHANNELS(channel), found.source);
  float change = 0.0f, size = sum_of_squares(colour), brightest = -1.0f;
  uint source = found.source;
  found.weight = 1.0f / (found.distance * found.distance);
  for (int i = 1; i <= 4; ++i) {
    const int2 at = start + nearest_px((found.distance + (float)(4 * i)) * direction);
    if (!is_inside(p.width, p.height, at)) break;
    const uint q = pixel_at(p.width, p.height, at);
    if (mixed[q] || abs(coc_of(coc_quanta, q) - coc) > 4 * DEFRAY_JUMP_QUANTA) continue;
    const float4 c = colour_at(CHANNELS(channel), q);
    change += sum_of_squares(c - colour);
    size += sum_of_squares(c);
    if (!(brightness(c) > brightest)) continue;
    brightest = brightness(c);
    source = q;
  }
  if (brightest < 0.0f) return found;
  if (isfinite(change) && isfinite(size)) {
    const float share = change > 0.0f ? fmin(change / size, 8.0f) : 0.0f;
    found.weight /= 0.1f + share;
  }
  if (found.distance > 4.0f && brightness(colour) > 3.0f * brightest) found.source = source;
  return found;
}

// 1/depth in front of a pixel: of a mixed one, that of the nearest surface around it.
float own_inverse_of(const DefrayFillParams p, __global const float* restrict inverse,
                     __global const uint* restrict mixed, const int2 at) {
  const uint pixel = pixel_at(p.width, p.height, at);
  float own = inverse[pixel];
  for (int i = 0; i < 9 && mixed[pixel]; ++i) {
    const uint q = pixel_at(p.width, p.height, at + (int2)(i % 3 - 1, i / 3 - 1));
    if (inverse[q] > own) own = inverse[q];
  }
  return own;
}

// Nothing behind the pixels of a run.
void clear_run(const DefrayFillParams p, __global const int* restrict coc_quanta, const int2 start,
               __global int* restrict behind_coc, __global float* restrict behind_inverse,
               WRITTEN_CHANNELS(behind)) {
  for (int i = 0; i < run_length(p.width, start); ++i) {
    const uint pixel = pixel_at(p.width, p.height, start + (int2)(i, 0));
    behind_inverse[pixel] = -1.0f;
    behind_coc[pixel] = coc_quanta[pixel];
    set_colour(CHANNELS(behind), pixel, (float4)(0.0f));
  }
}

// What the rays of a run's pixels in one direction have found.
void look_from_run(const DefrayFillParams p, __global const int* restrict coc_quanta,
                   __global const float* restrict inverse, __global const uint* restrict mixed,
                   CHANNEL_PARAMETERS(channel), const int2 start, const float2 direction,
                   const int16 own, const int farthest, Found* found) {
  int steps[RUN], owns[RUN];
  look_behind(p, coc_quanta, mixed, start, direction, own, farthest, steps);
  vstore16(own, 0, owns);
  for (int i = 0; i < RUN; ++i) {
    found[i].distance = 0.0f;
    if (steps[i] == 0) continue;
    const int2 at = start + (int2)(i, 0);
    const Found f = continue_back(p, coc_quanta, inverse, mixed, at, direction, steps[i], owns[i]);
    found[i] = look_further(p, coc_quanta, mixed, CHANNELS(channel), at, direction, f);
  }
}

// What lies behind a pixel, of what its rays have found, RUN apart.
void fill_pixel(const DefrayFillParams p, __global const float* restrict inverse,
                __global const uint* restrict mixed, CHANNEL_PARAMETERS(channel), const int2 at,
                const int own, const Found* by_direction, __global int* restrict behind_coc,
                __global float* restrict behind_inverse, WRITTEN_CHANNELS(behind)) {
  Found found[DEFRAY_FILL_DIRECTIONS];
  float bright[DEFRAY_FILL_DIRECTIONS];
  uint count = 0u, nearest = 0u;
  for (uint i = 0; i < p.directions; ++i) {
    const Found f = by_direction[i * RUN];
    if (f.distance == 0.0f) continue;
    found[count] = f;
    bright[count] = brightness(colour_at(CHANNELS(channel), f.source));
    if (f.distance < found[nearest].distance) nearest = count;
    ++count;
  }
  if (count == 0u) return;

  // The surface of the nearest alone: others' colours say nothing about its highlights.
  const float surface = found[nearest].coc;
  const float same = DEFRAY_JUMP_QUANTA + 0.125f * (surface - (float)own);
  uint on_it = 0u;
  for (uint i = 0; i < count; ++i) {
    if (fabs(found[i].coc - surface) > same) continue;
    found[on_it] = found[i];
    bright[on_it] = bright[i];
    ++on_it;
  }
  count = on_it;

  float median = 0.0f;
  for (uint i = 0; i < count; ++i) {
    if (rank_of(bright, count, i) == count / 2u) median = bright[i];
  }
  float weights = 0.0f, coc = 0.0f, inverse_sum = 0.0f, colour_weights = 0.0f;
  float4 colour = 0.0f;
  for (uint i = 0; i < count; ++i) {
    const Found f = found[i];
    const float weight = 1.0f / (f.distance * f.distance);
    weights += weight;
    coc += weight * f.coc;
    inverse_sum += weight * f.inverse;
    if (bright[i] > 10.0f * median) continue;
    colour_weights += f.weight;
    colour += f.weight * colour_at(CHANNELS(channel), f.source);
  }
  const uint pixel = pixel_at(p.width, p.height, at);
  behind_coc[pixel] = convert_int_rte(coc / weights);
  const float mean = inverse_sum / weights;
  const float most = own_inverse_of(p, inverse, mixed, at) * 0.99999f;
  behind_inverse[pixel] = mean < most ? mean : most;
  set_colour(CHANNELS(behind), pixel, colour / colour_weights);
}

__kernel void fill(const DefrayFillParams p, __global const int* restrict coc_quanta,
                   __global const float* restrict inverse, __global const uint* restrict mixed,
                   __global const int* restrict farthest, CHANNEL_PARAMETERS(channel),
                   __global int* restrict behind_coc, __global float* restrict behind_inverse,
                   WRITTEN_CHANNELS(behind)) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  clear_run(p, coc_quanta, start, behind_coc, behind_inverse, CHANNELS(behind));
  const uint tile = (uint)start.y / DEFRAY_FILL_TILE * p.tiles_x + (uint)start.x / DEFRAY_FILL_TILE;
  if (farthest[tile] == DEFRAY_NOTHING_BEHIND) return;

  const int16 own = own_of_run(p, coc_quanta, mixed, start);
  // Direction by direction: neighbours find what lies close together in memory.
  Found found[DEFRAY_FILL_DIRECTIONS * RUN];
  for (uint i = 0; i < p.directions; ++i) {
    look_from_run(p, coc_quanta, inverse, mixed, CHANNELS(channel), start, direction_of(p, i), own,
                  farthest[tile], found + i * RUN);
  }
  int owns[RUN];
  vstore16(own, 0, owns);
  for (int i = 0; i < run_length(p.width, start); ++i) {
    fill_pixel(p, inverse, mixed, CHANNELS(channel), start + (int2)(i, 0), owns[i], found + i,
               behind_coc, behind_inverse, CHANNELS(behind));
  }
}
