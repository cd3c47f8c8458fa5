// splat_project: a node of a point cloud -> its resampling kernel in the picture, blurred by the
// lens (Krivanek & Zara 2003, sections 4.2, 5.2, 5.3 and appendix A).
//
// The variance is W = J V_r J^T + I + circumellipse(J V_q J^T, V_I): J takes the scene to the
// picture around the node, V_r is the basis function's variance and V_q that of the places that the
// node stands for, I the prefilter of a pixel, V_I = C^2 / (2 ln 4) I the Gaussian nearest to the
// disc of the CoC. The kernel holds as much as the node covers of the picture, F^2 |A . p| / z^3
// for an area A at p, and ends where 1/2 d^T W^-1 d reaches c. There the paper cuts it off, which
// leaves 1 - e^-c of it. (Printed, the exponent lacks its 1/2: within d^T W^-1 d < c lies
// 1 - e^(-c/2).) Here it is lowered by e^-c, so that it ends at 0, which leaves 1 - e^-c (1 + c):
// kernels side by side then add up to 1 two to five times more evenly. Where it is sharp it holds
// `cover` times as much, so that neighbours leave no holes; of what that is more or less 1 -
// share^2 is left where the CoC has that share of W.
//
// A disc of variance C^2 / 4, blurred by the lowered Gaussian of the rest (variances add up), is
// s^2 (1 + bulge (1 - s)) with s = (T - t) / D within [0, 1] and t = d^T W^-1 d, which needs
// neither root nor power. D and bulge are fitted to such blurred discs by the share of the Gaussian
// in W, 0.005 to 0.4, within 0.03 of them in the mean square; T gives it the variance W. A slanted
// surface covers more of what is seen from the lens's one side than from the other, by A . (p - u)
// from u: kernels lean, and where that is 0 or less nothing of a surface with one side is seen.
//
// A node is culled, with no pixels, if any of its basis function is nearer than near_units, if
// surfaces have one side and it shows the other to all of the lens, or if it covers nothing of the
// picture.
//
// nodes   [count]
// ridges  sets of DEFRAY_SPLAT_RIDGES that nodes name
// splats  [count]
// lines   sets as of ridges, which splats that have pixels name
// A work-item: LANES nodes (base/lanes.clh), a lane each.
// Global size: count / LANES, rounded up, or more.
#include "splat/ridge_lines.clh"

#define FRAME_VECTOR(p, name) \
  { (p).name##_x, (p).name##_y, (p).name##_z }

// Signed radius, px: coc.cl without its rounding and without limits.
INLINED floats splat_coc(const DefraySplatParams p, const floats z) {
  return p.focus_is_infinite ? -p.infinite_focus_scale / z
                             : p.coc_scale_px * ((z - p.focus_units) / z);
}

// a^T V b.
INLINED floats between(const SplatVectors a, const SplatCovariances v, const SplatVectors b) {
  const SplatVectors vb = {v.xx * b.x + v.xy * b.y + v.xz * b.z,
                           v.xy * b.x + v.yy * b.y + v.yz * b.z,
                           v.xz * b.x + v.yz * b.y + v.zz * b.z};
  return product(a, vb);
}

// Of areas, whose squares are beyond floats.
INLINED floats size_of(const SplatVectors a) {
  const floats largest = fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z));
  const SplatVectors share = {a.x / largest, a.y / largest, a.z / largest};
  return select((floats)(0.0f), largest * sqrt(product(share, share)), IS(largest > 0.0f));
}

// The variance whose ellipse is the smallest around those of `m` and of a circle's variance: the
// larger of the two along each of m's axes (appendix A); of discs their sum.
INLINED SplatVariances circumellipse(const SplatVariances m, const floats circle,
                                     const ints is_disc) {
  const floats mean = 0.5f * (m.xx + m.yy), half_difference = 0.5f * (m.xx - m.yy);
  const floats spread = sqrt(half_difference * half_difference + m.xy * m.xy);
  const floats most = mean + spread, least = fmax(mean - spread, (floats)(0.0f));
  const floats longer = select(fmax(most, circle), most + circle, is_disc);
  const floats shorter = select(fmax(least, circle), least + circle, is_disc);
  const floats middle = 0.5f * (longer + shorter), stretch = 0.5f * (longer - shorter) / spread;
  const ints is_round = IS(spread == 0.0f);  // m, and with it the result
  const SplatVariances v = {select(middle + stretch * half_difference, longer, is_round),
                            select(stretch * m.xy, (floats)(0.0f), is_round),
                            select(middle - stretch * half_difference, longer, is_round),
                            select(shorter, longer, is_round)};
  return v;
}

// Of `own` + `prefilter` I + `added`, whose product of xx and yy and square of xy are almost the
// same where a surface is seen from its edge: `added` is a circle and what is longer along one
// axis, of `own` the root of the determinant is known, and no large numbers are subtracted.
INLINED floats determinant_of(const SplatVariances own, const floats root, const floats prefilter,
                              const SplatVariances added) {
  const floats circle = prefilter + added.shorter;
  const floats xx = added.xx - added.shorter, yy = added.yy - added.shorter;
  const floats across = own.xx * yy + own.yy * xx - 2.0f * (own.xy * added.xy);
  return root * root + circle * (own.xx + own.yy + xx + yy) + circle * circle +
         fmax(across, (floats)(0.0f));
}

// First pixel whose centre is not before `from`, within [0, size].
INLINED ints first_pixel(const floats from, const uint size) {
  return convert_ints(clamp(ceil(from - 0.5f), (floats)(0.0f), (floats)((float)size)));
}

// First pixel whose centre is beyond `to`, within [0, size].
INLINED ints end_pixel(const floats to, const uint size) {
  return convert_ints(clamp(floor(to - 0.5f) + 1.0f, (floats)(0.0f), (floats)((float)size)));
}

// Of a disc whose variance is all but `share` of the whole, and `share` a Gaussian: where t ends,
// D, bulge, and the integral over t.
typedef struct {
  floats end, fall, bulge, whole;
} BlurredDisc;

INLINED BlurredDisc blurred_disc(const floats share) {
  const floats size = sqrt(share);
  BlurredDisc d;
  d.fall = 15.8f * (size * sqrt(1.0f - share));
  d.bulge = clamp(2.54f - 5.4f * size, (floats)(0.0f), (floats)(2.0f));
  // The integrals of s^2 (1 + bulge (1 - s)), and times s, over [0, 1].
  const floats first = 0.333333343f + 0.0833333358f * d.bulge;
  const floats second = 0.25f + 0.05f * d.bulge;
  const floats flat = d.fall * (1.0f - first);
  d.end = flat + 2.0f +
          sqrt(fmax(flat * flat + 4.0f - d.fall * d.fall * (1.0f - 2.0f * second), (floats)(0.0f)));
  d.whole = d.end - flat;
  return d;
}

// The kernel's shape from its variance, for an amplitude of 1 at the centre of what covers `size`.
// `blur`: the variance of the CoC, which is in it. Returns its share.
INLINED floats shape_splats(const DefraySplatParams p, const SplatVariances variance,
                            const floats determinant, const floats size, const floats blur,
                            const ints is_disc, SplatLanes* s) {
  const floats root = sqrt(determinant);
  floats form = 0.5f, reach = 2.0f * p.cutoff, whole = 6.28318531f * root * p.gaussian_share;
  s->disc_top = s->disc_bulge = 0.0f;
  if (p.has_discs) {
    const floats gaussian = fmax(root - blur, (floats)(p.gaussian_variance));
    const BlurredDisc d = blurred_disc(fmin(gaussian / root, (floats)(0.4f)));
    form = select(form, 1.0f / d.fall, is_disc);
    reach = select(reach, d.end, is_disc);
    whole = select(whole, 3.14159274f * (root * d.whole), is_disc);
    s->disc_top = select(s->disc_top, d.end / d.fall, is_disc);
    s->disc_bulge = select(s->disc_bulge, d.bulge, is_disc);
  }
  const floats scale = form / determinant;
  s->conic_xx = variance.yy * scale;
  s->conic_xy = -variance.xy * scale;
  s->conic_yy = variance.xx * scale;
  s->amplitude = p.aim * size / whole;
  const floats half_x = sqrt(reach * variance.xx), half_y = sqrt(reach * variance.yy);
  s->first_x = first_pixel(s->x - half_x, p.width);
  s->end_x = end_pixel(s->x + half_x, p.width);
  s->first_y = first_pixel(s->y - half_y, p.height);
  s->end_y = end_pixel(s->y + half_y, p.height);
  return blur / root;
}

// How far the basis function reaches towards the camera: no less than its own width, or neighbours
// on a curved surface that faces the camera would lie apart.
INLINED floats half_depth_of(const DefraySplatParams p, const SplatNodes* n,
                             const SplatVectors forward, const SplatVectors normal) {
  const floats slant = product(forward, normal);
  const floats along = n->variance * (1.0f - slant * slant) + between(forward, n->low, forward);
  return fmax(sqrt(2.0f * p.cutoff * along), sqrt(n->variance));
}

// A row of the Jacobian.
INLINED SplatVectors jacobian_row(const SplatVectors axis, const SplatVectors forward,
                                  const floats tan, const floats scale) {
  const SplatVectors row = {scale * (axis.x - tan * forward.x), scale * (axis.y - tan * forward.y),
                            scale * (axis.z - tan * forward.z)};
  return row;
}

// The kernel's shape. `blur`: the variance of the CoC. Returns what share of it that is.
INLINED floats blur_nodes(const DefraySplatParams p, const SplatNodes* n, const SeenNodes* seen,
                          const floats blur, const ints is_disc, SplatLanes* s) {
  // What is left of a Gaussian's variance counts, beside that of a disc.
  const floats kept = select((floats)(1.0f), (floats)(p.gaussian_variance), is_disc);
  const SplatVectors to_x = seen->row_x, to_y = seen->row_y;
  const SplatVariances low = {between(to_x, n->low, to_x), between(to_x, n->low, to_y),
                              between(to_y, n->low, to_y), 0.0f};
  const SplatVariances added = circumellipse(low, blur, is_disc);
  const floats tilt_x = product(to_x, seen->normal), tilt_y = product(to_y, seen->normal);
  const floats along = kept * n->variance;
  const SplatVariances own = {along * (product(to_x, to_x) - tilt_x * tilt_x),
                              along * (product(to_x, to_y) - tilt_x * tilt_y),
                              along * (product(to_y, to_y) - tilt_y * tilt_y), 0.0f};
  const SplatVariances variance = {own.xx + kept + added.xx, own.xy + added.xy,
                                   own.yy + kept + added.yy, 0.0f};
  const floats determinant = determinant_of(own, along * seen->spread, kept, added);
  const floats share = shape_splats(p, variance, determinant, seen->size, blur, is_disc, s);
  const floats sharp = 1.0f - share * share;
  s->amplitude *= 1.0f + (n->cover - 1.0f) * sharp;
  s->set = n->set;
  if (!any_of(IS(n->set != 0))) return share;
  const floats around = kept + blur;
  s->lines[0] = end_at_ridge(n->ridges[0], seen, own, around, variance, determinant, sharp);
  s->lines[1] = end_at_ridge(n->ridges[1], seen, own, around, variance, determinant, sharp);
  return share;
}

// How much of a node is seen, from an amplitude of 1, from that point of the lens whose light each
// pixel has, on average: the CoC's share of the way there. Returns whether any is.
INLINED ints face_lens(const DefraySplatParams p, const SeenNodes* seen, const ints has_back,
                       const floats coc, const floats sharp_coc, const floats share,
                       SplatLanes* s) {
  s->back = select((floats)(0.0f), (floats)(-1.0f), has_back);
  const SplatVectors right = FRAME_VECTOR(p, right), down = FRAME_VECTOR(p, down);
  const floats lean_x = product(right, seen->normal), lean_y = product(down, seen->normal);
  // In focus a pixel has light from all of the lens.
  const floats units_a_px =
      select((floats)(0.0f), share * (p.lens_units / sharp_coc), IS(sharp_coc != 0.0f));
  s->lean_x = s->amplitude * (units_a_px * lean_x);
  s->lean_y = s->amplitude * (units_a_px * lean_y);
  s->amplitude *= -seen->towards;
  const floats most = fabs(coc * units_a_px) * sqrt(lean_x * lean_x + lean_y * lean_y);
  return IS(most - seen->towards > 0.0f) | has_back;
}

INLINED void project_nodes(const DefraySplatParams p, const SplatNodes* n, SplatLanes* s) {
  const SplatVectors right = FRAME_VECTOR(p, right), down = FRAME_VECTOR(p, down);
  const SplatVectors forward = FRAME_VECTOR(p, forward);
  const SplatVectors from_eye = {n->place.x - p.eye_x, n->place.y - p.eye_y, n->place.z - p.eye_z};
  const floats size = size_of(n->area);
  SeenNodes seen;
  seen.normal.x = n->area.x / size;
  seen.normal.y = n->area.y / size;
  seen.normal.z = n->area.z / size;
  const floats z = product(forward, from_eye), towards = product(seen.normal, from_eye);
  const floats half_depth = half_depth_of(p, n, forward, seen.normal);
  s->z = z;
  s->z_near = z - half_depth;
  s->z_far = z + half_depth;

  const floats scale = p.focal_px / z;
  const floats tan_x = product(right, from_eye) / z, tan_y = product(down, from_eye) / z;
  s->x = p.centre_x + p.focal_px * tan_x;
  s->y = p.centre_y + p.focal_px * tan_y;
  seen.row_x = jacobian_row(right, forward, tan_x, scale);
  seen.row_y = jacobian_row(down, forward, tan_y, scale);
  seen.towards = towards;
  seen.spread = scale * scale * (fabs(towards) / z);
  seen.size = scale * scale * (size / z);

  const floats sharp_coc = splat_coc(p, z);
  const floats coc = clamp(sharp_coc, (floats)(-p.limit_px), (floats)(p.limit_px));
  const floats own = 1.0f + scale * scale * n->variance;
  const ints is_disc = IS(coc * coc > DEFRAY_SPLAT_DISC * own) & (ints)(p.has_discs ? -1 : 0);
  // 1/4, or 1 / (2 ln 4)
  const floats blur = select((floats)(0.36067376f), (floats)(0.25f), is_disc) * (coc * coc);
  const floats share = blur_nodes(p, n, &seen, blur, is_disc, s);
  const ints has_back = IS(n->both_sides > 0.5f) | (ints)(p.one_sided ? 0 : -1);
  const ints faces = face_lens(p, &seen, has_back, coc, sharp_coc, share, s);

  // A light at the eye: a third of it from all around.
  floats light = 1.0f;
  if (p.has_headlight) {
    const floats facing = fabs(towards) / sqrt(product(from_eye, from_eye));
    light = 0.333333343f + 0.666666687f * facing;
  }
  s->r = n->r * light;
  s->g = n->g * light;
  s->b = n->b * light;
  s->a = n->a;
  const ints is_seen = IS(size > 0.0f) & IS(z - half_depth > p.near_units) & faces;
  const ints covers = IS(fabs(s->amplitude) + fabs(s->lean_x) + fabs(s->lean_y) > 0.0f);
  cull(s, is_seen, covers);
}

__kernel void splat_project(const DefraySplatParams p, __global const DefraySplatNode* nodes,
                            __global const DefraySplatRidge* ridges, __global DefraySplat* splats,
                            __global DefraySplatLine* lines) {
  const uint first = (uint)get_global_id(0) * LANES;
  if (first >= p.count) return;
  const uint count = min((uint)LANES, p.count - first);
  const SplatNodes n =
      read_nodes(nodes, ridges, min(as_uints((ints)(LANE)) + first, (uints)(p.count - 1)));
  SplatLanes s;
  project_nodes(p, &n, &s);
  write_splats(&s, splats + first, lines, count);
}
