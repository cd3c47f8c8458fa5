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
// kernels side by side then add up to 1 two to five times more evenly. A disc has a variance of 1/4
// of its square radius, and an edge one pixel wide.
//
// A node is culled, with no pixels, if any of its basis function is nearer than near_units, if
// surfaces have one side and it shows the other, or if it covers nothing of the picture.
//
// nodes   [count]
// splats  [count]
// A work-item: LANES nodes (base/lanes.clh), a lane each.
// Global size: count / LANES, rounded up, or more.
#include "splat/node_lanes.clh"

#define FRAME_VECTOR(p, name) \
  { (p).name##_x, (p).name##_y, (p).name##_z }

// Signed radius, px: coc.cl without its rounding.
INLINED floats splat_coc(const DefraySplatParams p, const floats z) {
  const floats radius = p.focus_is_infinite ? -p.infinite_focus_scale / z
                                            : p.coc_scale_px * ((z - p.focus_units) / z);
  return clamp(radius, (floats)(-p.limit_px), (floats)(p.limit_px));
}

INLINED floats product(const SplatVectors a, const SplatVectors b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
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
// larger of the two along each of m's axes (appendix A).
INLINED SplatVariances circumellipse(const SplatVariances m, const floats circle) {
  const floats mean = 0.5f * (m.xx + m.yy), half_difference = 0.5f * (m.xx - m.yy);
  const floats spread = sqrt(half_difference * half_difference + m.xy * m.xy);
  const floats longer = fmax(mean + spread, circle), shorter = fmax(mean - spread, circle);
  const floats middle = 0.5f * (longer + shorter), stretch = 0.5f * (longer - shorter) / spread;
  // Round, where the longer is the shorter or m itself is a circle.
  const ints is_round = IS(mean + spread <= circle) | IS(spread == 0.0f);
  const SplatVariances v = {select(middle + stretch * half_difference, longer, is_round),
                            select(stretch * m.xy, (floats)(0.0f), is_round),
                            select(middle - stretch * half_difference, longer, is_round),
                            select(shorter, longer, is_round)};
  return v;
}

// Of `own` + I + `added`, whose product of xx and yy and square of xy are almost the same where a
// surface is seen from its edge: `added` is a circle and what is longer along one axis, of `own`
// the root of the determinant is known, and no large numbers are subtracted.
INLINED floats determinant_of(const SplatVariances own, const floats root,
                              const SplatVariances added) {
  const floats circle = 1.0f + added.shorter;
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

// The kernel's shape from its variance.
INLINED void shape_splats(const DefraySplatParams p, const SplatVariances variance,
                          const floats determinant, const floats mass, const ints is_disc,
                          SplatLanes* s) {
  const floats root = sqrt(determinant);
  const floats form = select((floats)(0.5f), (floats)(0.25f), is_disc) / determinant;
  s->conic_xx = variance.yy * form;
  s->conic_xy = -variance.xy * form;
  s->conic_yy = variance.xx * form;
  floats reach = 2.0f * p.cutoff, whole = 6.28318531f * root * p.gaussian_share;
  s->disc_px = 0.0f;
  if (p.has_discs) {
    const floats radius = 2.0f * sqrt(root), edge = 1.0f + 0.5f / radius;
    s->disc_px = select(s->disc_px, radius, is_disc);
    // pi (r^2 + 1/12), r^2 = 4 root
    whole = select(whole, 12.5663706f * root + 0.261799388f, is_disc);
    reach = select(reach, 4.0f * edge * edge, is_disc);
  }
  s->amplitude = mass / whole;
  const floats half_x = sqrt(reach * variance.xx), half_y = sqrt(reach * variance.yy);
  s->first_x = first_pixel(s->x - half_x, p.width);
  s->end_x = end_pixel(s->x + half_x, p.width);
  s->first_y = first_pixel(s->y - half_y, p.height);
  s->end_y = end_pixel(s->y + half_y, p.height);
}

// 0 where it is not known.
INLINED floats known(const floats value, const ints is_known) {
  return select((floats)(0.0f), value, is_known);
}

// Of what is not seen nothing is kept but its depths, of what covers nothing no shape.
INLINED void cull(SplatLanes* s, const ints is_seen, const ints covers) {
  s->x = known(s->x, is_seen);
  s->y = known(s->y, is_seen);
  s->r = known(s->r, is_seen);
  s->g = known(s->g, is_seen);
  s->b = known(s->b, is_seen);
  s->a = known(s->a, is_seen);
  const ints has_shape = is_seen & covers;
  s->conic_xx = known(s->conic_xx, has_shape);
  s->conic_xy = known(s->conic_xy, has_shape);
  s->conic_yy = known(s->conic_yy, has_shape);
  s->amplitude = known(s->amplitude, has_shape);
  s->disc_px = known(s->disc_px, has_shape);
  const ints has_pixels = has_shape & IS(s->first_x < s->end_x) & IS(s->first_y < s->end_y);
  s->first_x &= has_pixels;
  s->end_x &= has_pixels;
  s->first_y &= has_pixels;
  s->end_y &= has_pixels;
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

// Shape and mass of what lies at depth z, from its Jacobian. `spread`: of a unit of area.
INLINED void blur_nodes(const DefraySplatParams p, const SplatNodes* n, const SplatVectors row_x,
                        const SplatVectors row_y, const SplatVectors normal, const floats scale,
                        const floats spread, const floats mass, SplatLanes* s) {
  const floats coc = splat_coc(p, s->z);
  const ints is_disc = IS(fabs(coc) > DEFRAY_SPLAT_DISC * (1.0f + scale * sqrt(n->variance))) &
                       (ints)(p.has_discs ? -1 : 0);
  // 1/4, or 1 / (2 ln 4)
  const floats blur = select((floats)(0.36067376f), (floats)(0.25f), is_disc) * (coc * coc);
  const SplatVariances low = {between(row_x, n->low, row_x), between(row_x, n->low, row_y),
                              between(row_y, n->low, row_y), 0.0f};
  const SplatVariances added = circumellipse(low, blur);
  const floats tilt_x = product(row_x, normal), tilt_y = product(row_y, normal);
  const SplatVariances own = {n->variance * (product(row_x, row_x) - tilt_x * tilt_x),
                              n->variance * (product(row_x, row_y) - tilt_x * tilt_y),
                              n->variance * (product(row_y, row_y) - tilt_y * tilt_y), 0.0f};
  const SplatVariances variance = {own.xx + 1.0f + added.xx, own.xy + added.xy,
                                   own.yy + 1.0f + added.yy, 0.0f};
  const floats determinant = determinant_of(own, n->variance * spread, added);
  shape_splats(p, variance, determinant, mass, is_disc, s);
}

INLINED void project_nodes(const DefraySplatParams p, const SplatNodes* n, SplatLanes* s) {
  const SplatVectors right = FRAME_VECTOR(p, right), down = FRAME_VECTOR(p, down);
  const SplatVectors forward = FRAME_VECTOR(p, forward);
  const SplatVectors from_eye = {n->place.x - p.eye_x, n->place.y - p.eye_y, n->place.z - p.eye_z};
  const floats size = size_of(n->area);
  const SplatVectors normal = {n->area.x / size, n->area.y / size, n->area.z / size};
  const floats z = product(forward, from_eye), towards = product(normal, from_eye);
  const floats half_depth = half_depth_of(p, n, forward, normal);
  s->z = z;
  s->z_near = z - half_depth;
  s->z_far = z + half_depth;
  const ints is_seen = IS(size > 0.0f) & IS(z - half_depth > p.near_units) &
                       (IS(towards < 0.0f) | (ints)(p.one_sided ? 0 : -1));

  const floats scale = p.focal_px / z;
  const floats tan_x = product(right, from_eye) / z, tan_y = product(down, from_eye) / z;
  s->x = p.centre_x + p.focal_px * tan_x;
  s->y = p.centre_y + p.focal_px * tan_y;
  const floats spread = scale * scale * (fabs(towards) / z), mass = spread * size;
  blur_nodes(p, n, jacobian_row(right, forward, tan_x, scale),
             jacobian_row(down, forward, tan_y, scale), normal, scale, spread, mass, s);

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
  cull(s, is_seen, IS(mass > 0.0f));
}

__kernel void splat_project(const DefraySplatParams p, __global const DefraySplatNode* nodes,
                            __global DefraySplat* splats) {
  const uint first = (uint)get_global_id(0) * LANES;
  if (first >= p.count) return;
  const uint count = min((uint)LANES, p.count - first);
  const SplatNodes n = read_nodes(nodes, min(as_uints((ints)(LANE)) + first, (uints)(p.count - 1)));
  SplatLanes s;
  project_nodes(p, &n, &s);
  write_splats(&s, splats + first, count);
}
