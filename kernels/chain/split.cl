// split: mixed pixels' colours taken apart into the surface in front and the one behind it, and all
// of them as the two layers of one frame.
//
// With F the colour of the surface in front (pure pixels nearby), B that behind it (from `fill`, or
// from pure pixels if the depth sample saw another one, or if theirs explains the pixel better),
// the pixel's colour C = a F + (1 - a) B has the coverage a nearest to it (least squares; alpha
// counts like a colour). What the two colours do not explain goes to the surface that the depth
// sample saw, so that both together still give C; but what lies behind gets no colour beyond C, B
// and those of its pure pixels nearby. Where something before a lamp has its light in part, which
// tells by a colour far brighter than F and B, the lamp is behind it; of something thin, its own
// colours are those that the lamp does not light.
//
// coc_quanta, inverse, mixed, channel0..3  [height][width]  as in fill
// behind_coc      [height][width]     from fill: what lies behind
// behind_inverse  [height][width]     1/depth; negative: nothing there
// behind0..3      [height][width]     colour
// layer_coc       [height][2][width]  what is in front, and what lies behind
// layer_depth     [height][2][width]  DEFRAY_EMPTY's bits: nothing there
// layer_coverage  [height][2][width]  2^-16 of the pixel, and flags; 0: nothing there. What lies in
//                                     the margin was not seen
// layer0..3       [height][2][width]  colour
// Global size: (width, height).
#include "chain/split_nearby.clh"

// Coverages that are as good as none or all; and bounds, beyond which differences grow too much.
#define LEAST_COVERAGE 0.03f
#define MOST_OF_BEHIND 0.75f
#define LEAST_OF_FRONT 0.25f
// Of an edge anywhere between two pixels' centres, what the nearer one of a surface covers.
#define LIKELY_COVERAGE 0.875f
// So much do the surfaces' variances count against the difference of their colours, within shares
// of the squares of those. (0, 2 and 4 times, 640x400: fence fence 39.46, 39.59, 39.62 dB, the
// others within 0.03; at most 1 %: 39.53, 10 %: 39.62, `cutout` far at 96x72 -0.1; no bound:
// spheres -0.5.)
#define NOISE 2.0f
#define LEAST_NOISE 1e-3f
#define MOST_NOISE 3e-2f
// Of what is in focus an edge is sharp, and so is whatever shows through there, unless it is taken
// apart: where what lies behind is blurred by at least 2 px, and as far as both surfaces'
// variances, and what their colours do not explain, so many times, are small beside the difference
// of the two. (480x300; as before, then 2 and 4, 4 and 16, 4 and 64, 16 and 16 times:
// plate1 41.27, 42.51, 42.48, 42.48, 42.33 dB; garden post 34.74, 35.07, 35.06, 35.01, 35.01; fence
// fence 40.12, 39.97, 40.15, 40.18, 40.22; from no blur on: lines at 96x72 -0.5 dB.)
#define IN_FOCUS_LEAST_BLUR 512
#define IN_FOCUS_NOISE 4.0f
#define IN_FOCUS_MISFIT 64.0f

// A surface in one pixel.
typedef struct {
  int coc;
  float inverse;  // 1/depth; negative: there is none
  uint coverage;
  float4 colour;
} Surface;

// C beside what F and B can make: the share of F that comes nearest, and how far from it C stays,
// squared.
typedef struct {
  float along, length2, share, misfit2;
} Fit;

Fit fit_of(const float4 c, const float4 f, const float4 b) {
  const float4 from_b = c - b, all = f - b;
  Fit fit;
  fit.along = product_of(from_b, all);
  fit.length2 = product_of(all, all);
  fit.share = fit.length2 > 0.0f ? clamp(fit.along / fit.length2, 0.0f, 1.0f) : 0.0f;
  const float4 left = from_b - fit.share * all;
  fit.misfit2 = product_of(left, left);
  return fit;
}

// Share of the pixel that F covers. Where F and B are no more unlike than each is in itself, colour
// says little and the depth sample decides: it most likely saw the larger share. The more of C the
// two leave unexplained, the less of it is taken apart. Colours that are not finite, or whose
// squares are not, say nothing: the pixel stays whole.
float coverage_of(const float4 c, const float4 f, const float4 b, const float variance,
                  const bool saw_front) {
  const Fit fit = fit_of(c, f, b);
  const float4 sizes = f * f + b * b;
  const float size2 = sizes.x + sizes.y + sizes.z + sizes.w;
  const float unsure = fmin(LEAST_NOISE * size2 + NOISE * variance, MOST_NOISE * size2);
  const float all2 = fit.length2 + unsure;
  const float likely = saw_front ? LIKELY_COVERAGE : 1.0f - LIKELY_COVERAGE;
  if (!isfinite(fit.along) || !isfinite(all2)) return saw_front ? 1.0f : 0.0f;
  if (all2 == 0.0f) return likely;
  const float mean = (fit.share * fit.length2 + likely * unsure) / all2;
  const float explained = all2 / (all2 + fit.misfit2);
  return saw_front ? 1.0f - (1.0f - mean) * explained : mean * explained;
}

// As coverage_of, of what is in focus.
float coverage_in_focus(const float4 c, const float4 f, const float4 b, const float variance) {
  const Fit fit = fit_of(c, f, b);
  const float unsure = IN_FOCUS_NOISE * variance + IN_FOCUS_MISFIT * fit.misfit2;
  const float all2 = fit.length2 + unsure;
  if (!isfinite(fit.along) || !isfinite(all2) || all2 == 0.0f) return 1.0f;
  return 1.0f - (1.0f - fit.share) * fit.length2 / all2;
}

// Of what may lie behind F, what explains C: what was made up, unless another comes twice as near.
// (Of 1, 4 and 16 times as near, squared: fence fence at 96x72 -0.2, 0, 0 dB; random layers +0.15,
// +0.08 dB in the mean; fence bg +0.09, +0.07.)
float4 best_behind(const float4 c, const float4 f, const float4 made_up, const float4 nearest,
                   const float4 mean) {
  float4 best = made_up;
  if (fit_of(c, f, nearest).misfit2 < 0.25f * fit_of(c, f, best).misfit2) best = nearest;
  if (fit_of(c, f, mean).misfit2 < 0.25f * fit_of(c, f, best).misfit2) best = mean;
  return best;
}

// A coverage in 2^-16 and, of the very share that is stored, what is left of C for one surface when
// the other has its part: never below 0 where C is not.
uint stored(const float share) { return convert_uint_rte(share * 65536.0f); }

float4 rest_of(const float4 c, const float4 other, const float others_share) {
  const float4 rest = (c - others_share * other) / (1.0f - others_share);
  const float4 least = c < 0.0f ? c : (float4)(0.0f);
  return rest < least ? least : rest;
}

// Within what is known of that surface, and C: taken apart wrongly, a pixel would get colours that
// nothing around it has.
float4 plausible(const Nearby seen, const float4 b, const float4 c, const float4 rest) {
  const float4 low = lower_of(seen.low, lower_of(b, c));
  const float4 high = higher_of(seen.high, higher_of(b, c));
  return rest < low ? low : rest > high ? high : rest;
}

// Whether what the second surface shows is a mixture of the first and B: then anti-aliased depth
// lies between theirs. (Not asked: `highlights` with such depth -2.5 dB, garden grass -0.14.)
bool is_mixture(const float4 second, const float4 first, const float4 b) {
  const float misfit2 = fit_of(second, first, b).misfit2;
  return !(misfit2 > (1.0f - BEYOND) * product_of(second - b, second - b));
}

// What is in front of `behind` in a pixel of colour C: the nearest surface around, unless one
// between that and the farthest explains C better: something thin before what a pixel beside it
// shows. (At 640x400 garden grass +0.05 dB, lines +0.09; ratios of 1/4, 1/2 and 1 are as good, and
// so are surfaces beyond the second.)
Front best_front(const DefraySplitParams p, __global const int* restrict coc_quanta,
                 __global const uint* restrict mixed, CHANNEL_PARAMETERS(channel), const int2 at,
                 const float4 c, const float4 behind) {
  int nearest = INT_MAX, farthest = INT_MIN, second = INT_MAX;
  for (int i = 0; i < 9; ++i) {
    const int coc = coc_around(p, coc_quanta, at, i);
    nearest = min(nearest, coc);
    farthest = max(farthest, coc);
  }
  for (int i = 0; i < 9; ++i) {
    const int coc = coc_around(p, coc_quanta, at, i);
    if (coc > nearest + DEFRAY_JUMP_QUANTA) second = min(second, coc);
  }
  const Front front =
      front_of(p, coc_quanta, mixed, CHANNELS(channel), at, nearest, farthest, c, behind);
  if (second >= farthest - DEFRAY_JUMP_QUANTA || !front.surface.is_found) return front;
  const Front other =
      front_of(p, coc_quanta, mixed, CHANNELS(channel), at, second, farthest, c, behind);
  const float4 f1 = front.surface.colour, f2 = other.surface.colour;
  const bool is_better = other.surface.is_found && !is_mixture(f2, f1, behind) &&
                         fit_of(c, f2, behind).misfit2 < fit_of(c, f1, behind).misfit2;
  return is_better ? other : front;
}

// A mixed pixel: both surfaces with their shares of it, where it can be taken apart.
void part(const DefraySplitParams p, __global const int* restrict coc_quanta,
          __global const float* restrict inverse, __global const uint* restrict mixed,
          CHANNEL_PARAMETERS(channel), const int2 at, Surface* front, Surface* behind) {
  const uint pixel = pixel_at(p.width, p.height, at);
  const float4 c = front->colour;
  const int own = coc_of(coc_quanta, pixel);
  float4 b = behind->colour;
  const Front best = best_front(p, coc_quanta, mixed, CHANNELS(channel), at, c, b);
  Nearby f = best.surface;
  bool saw_front = own < best.middle, is_lit = false;
  if (saw_front && brightness_of(c) > best.brightest) {
    const uint lamp = lamp_beside(p, coc_quanta, CHANNELS(channel), at, best.middle);
    is_lit = lamp != pixel;
    if (is_lit) {  // as if the depth sample had seen the lamp
      saw_front = false;
      front->coc = coc_quanta[lamp];
      front->inverse = inverse[lamp];
      f.source = pixel;
      b = colour_at(CHANNELS(channel), lamp);
    }
  }
  Nearby seen = f;
  if (is_lit) {  // of the lamp no more is known
    seen.low = INFINITY;
    seen.high = -INFINITY;
    seen.variance = 0.0f;
  }
  if (!saw_front && !is_lit) {
    seen = pure_nearby(p, coc_quanta, mixed, CHANNELS(channel), at, own - DEFRAY_JUMP_QUANTA,
                       own + DEFRAY_JUMP_QUANTA);
    // Where `fill` found another surface than the one that was seen there are three.
    const bool is_third = abs(tame(behind->coc) - own) > DEFRAY_JUMP_QUANTA;
    if (is_third && seen.is_found) {
      b = seen.colour;
    } else if (seen.is_found && f.is_found) {
      b = best_behind(c, f.colour, b, colour_at(CHANNELS(channel), seen.source), seen.colour);
    }
  }
  float share = saw_front ? 1.0f : 0.0f;
  if (saw_front && !best.is_thin && abs(best.nearest) < DEFRAY_SMALL_QUANTA) {  // in focus
    const int far = tame(behind->coc);
    if (abs(far) < IN_FOCUS_LEAST_BLUR) return;
    const Nearby beyond = pure_nearby(p, coc_quanta, mixed, CHANNELS(channel), at,
                                      far - DEFRAY_JUMP_QUANTA, far + DEFRAY_JUMP_QUANTA);
    if (beyond.is_found) {
      const float4 nearest = colour_at(CHANNELS(channel), beyond.source);
      b = best_behind(c, f.colour, b, nearest, beyond.colour);
    }
    share = coverage_in_focus(c, f.colour, b, f.variance + beyond.variance);
  } else if (f.is_found) {
    const float variance = saw_front ? f.variance : f.variance + seen.variance;
    share = coverage_of(c, f.colour, b, variance, saw_front);
  }
  if (saw_front) {
    if (share > 1.0f - LEAST_COVERAGE) return;
    front->coverage = stored(fmax(share, LEAST_OF_FRONT));
    front->colour = rest_of(c, b, 1.0f - (float)front->coverage * 0x1p-16f);
  } else if (share < LEAST_COVERAGE) {
    behind->inverse = -1.0f;
  } else {
    const uint kept = stored(fmin(share, MOST_OF_BEHIND));
    const float4 rest = rest_of(c, f.colour, (float)kept * 0x1p-16f);
    const Surface left = {front->coc, front->inverse, DEFRAY_WHOLE, plausible(seen, b, c, rest)};
    const Surface before = {coc_quanta[f.source], inverse[f.source], kept, f.colour};
    *behind = left;
    *front = before;
  }
}

void set_layer(const Surface s, const bool is_in_margin, const size_t at,
               __global int* restrict layer_coc, __global float* restrict layer_depth,
               __global uint* restrict layer_coverage, WRITTEN_CHANNELS(layer)) {
  const bool is_nothing = s.inverse < 0.0f;
  const float z = s.inverse == 0.0f ? INFINITY : 1.0f / s.inverse;
  layer_coc[at] = s.coc;
  layer_depth[at] = is_nothing ? as_float(DEFRAY_EMPTY) : z;
  layer_coverage[at] = is_nothing ? 0u : s.coverage | (is_in_margin ? DEFRAY_SYNTHESISED : 0u);
  set_colour(CHANNELS(layer), at, s.colour);
}

__kernel void split(const DefraySplitParams p, __global const int* restrict coc_quanta,
                    __global const float* restrict inverse, __global const uint* restrict mixed,
                    CHANNEL_PARAMETERS(channel), __global const int* restrict behind_coc,
                    __global const float* restrict behind_inverse, CHANNEL_PARAMETERS(behind),
                    __global int* restrict layer_coc, __global float* restrict layer_depth,
                    __global uint* restrict layer_coverage, WRITTEN_CHANNELS(layer)) {
  const int2 at = work_item();
  if (!is_inside(p.width, p.height, at)) return;
  const uint pixel = pixel_at(p.width, p.height, at);
  Surface front = {coc_quanta[pixel], inverse[pixel], DEFRAY_WHOLE,
                   colour_at(CHANNELS(channel), pixel)};
  Surface behind = {behind_coc[pixel], behind_inverse[pixel], DEFRAY_WHOLE | DEFRAY_SYNTHESISED,
                    colour_at(CHANNELS(behind), pixel)};
  if (mixed[pixel] && behind.inverse >= 0.0f) {
    part(p, coc_quanta, inverse, mixed, CHANNELS(channel), at, &front, &behind);
  }
  const uint x = at.x, y = p.first_row + at.y;
  const bool is_in_margin =
      x < p.margin || x + p.margin >= p.width || y < p.margin || y + p.margin >= p.frame_height;
  const size_t to = (size_t)at.y * 2u * p.width + at.x;
  set_layer(front, is_in_margin, to, layer_coc, layer_depth, layer_coverage, CHANNELS(layer));
  set_layer(behind, is_in_margin, to + p.width, layer_coc, layer_depth, layer_coverage,
            CHANNELS(layer));
}
