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
// Global size: count, or more.
#include "base/any.clh"
#include "splat_params.h"

#define FRAME_VECTOR(p, name) ((float3)((p).name##_x, (p).name##_y, (p).name##_z))

// Signed radius, px: coc.cl without its rounding.
INLINED float splat_coc(const DefraySplatParams p, const float z) {
  const float radius = p.focus_is_infinite ? -p.infinite_focus_scale / z
                                           : p.coc_scale_px * ((z - p.focus_units) / z);
  return clamp(radius, -p.limit_px, p.limit_px);
}

// a^T V b of a symmetric V.
INLINED float between(const float3 a, __global const DefraySplatNode* n, const float3 b) {
  const float x = n->low_xx * b.x + n->low_xy * b.y + n->low_xz * b.z;
  const float y = n->low_xy * b.x + n->low_yy * b.y + n->low_yz * b.z;
  const float z = n->low_xz * b.x + n->low_yz * b.y + n->low_zz * b.z;
  return a.x * x + a.y * y + a.z * z;
}

INLINED float product(const float3 a, const float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Of areas, whose squares are beyond floats.
INLINED float size_of(const float3 a) {
  const float largest = fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z));
  if (!(largest > 0.0f)) return 0.0f;
  const float3 share = a / largest;
  return largest * sqrt(product(share, share));
}

// The variance (xx, xy, yy) whose ellipse is the smallest around those of `m` and of a circle's
// variance: the larger of the two along each of m's axes (appendix A). Last, that of its shorter
// one.
INLINED float4 circumellipse(const float3 m, const float circle) {
  const float mean = 0.5f * (m.x + m.z), half_difference = 0.5f * (m.x - m.z);
  const float spread = sqrt(half_difference * half_difference + m.y * m.y);
  if (mean + spread <= circle) return (float4)(circle, 0.0f, circle, circle);
  const float longer = mean + spread, shorter = fmax(mean - spread, circle);
  if (spread == 0.0f) return (float4)(longer, 0.0f, longer, longer);
  const float middle = 0.5f * (longer + shorter), stretch = 0.5f * (longer - shorter) / spread;
  return (float4)(middle + stretch * half_difference, stretch * m.y,
                  middle - stretch * half_difference, shorter);
}

// Of `own` + I + `added`, whose product of xx and yy and square of xy are almost the same where a
// surface is seen from its edge: `added` is a circle and what is longer along one axis, of `own`
// the root of the determinant is known, and no large numbers are subtracted.
INLINED float determinant_of(const float3 own, const float root, const float4 added) {
  const float circle = 1.0f + added.w;
  const float xx = added.x - added.w, yy = added.z - added.w;
  const float across = own.x * yy + own.z * xx - 2.0f * (own.y * added.y);
  return root * root + circle * (own.x + own.z + xx + yy) + circle * circle + fmax(across, 0.0f);
}

// First pixel whose centre is not before `from`, and first whose is beyond `to`, within [0, size].
INLINED int2 pixels_between(const float from, const float to, const uint size) {
  const float last = (float)size;
  return (int2)((int)clamp(ceil(from - 0.5f), 0.0f, last),
                (int)clamp(floor(to - 0.5f) + 1.0f, 0.0f, last));
}

// The kernel's shape from its variance; false where it covers no pixel.
INLINED bool shape_splat(const DefraySplatParams p, const float3 variance, const float determinant,
                         const float mass, const bool is_disc, DefraySplat* s) {
  const float root = sqrt(determinant);
  const float form = (is_disc ? 0.25f : 0.5f) / determinant;
  s->conic_xx = variance.z * form;
  s->conic_xy = -variance.y * form;
  s->conic_yy = variance.x * form;
  float reach = 2.0f * p.cutoff;
  if (is_disc) {
    s->disc_px = 2.0f * sqrt(root);
    s->amplitude = mass / (12.5663706f * root + 0.261799388f);  // pi (r^2 + 1/12), r^2 = 4 root
    const float edge = 1.0f + 0.5f / s->disc_px;
    reach = 4.0f * edge * edge;
  } else {
    s->disc_px = 0.0f;
    s->amplitude = mass / (6.28318531f * root * p.gaussian_share);
  }
  const float half_x = sqrt(reach * variance.x), half_y = sqrt(reach * variance.z);
  const int2 columns = pixels_between(s->x - half_x, s->x + half_x, p.width);
  const int2 rows = pixels_between(s->y - half_y, s->y + half_y, p.height);
  s->first_x = columns.x;
  s->end_x = columns.y;
  s->first_y = rows.x;
  s->end_y = rows.y;
  return columns.x < columns.y && rows.x < rows.y;
}

// Fills in the splat; false: culled.
INLINED bool project_node(const DefraySplatParams p, __global const DefraySplatNode* n,
                          DefraySplat* s) {
  const float3 right = FRAME_VECTOR(p, right), down = FRAME_VECTOR(p, down);
  const float3 forward = FRAME_VECTOR(p, forward);
  const float3 from_eye = (float3)(n->x, n->y, n->z) - FRAME_VECTOR(p, eye);
  const float3 area = (float3)(n->area_x, n->area_y, n->area_z);
  const float x = product(right, from_eye), y = product(down, from_eye);
  const float z = product(forward, from_eye);

  // The basis function's depth: no thinner than its own width, or neighbours on a curved surface
  // that faces the camera would lie apart.
  const float size = size_of(area);
  const float3 normal = area / size;
  const float slant = product(forward, normal);
  const float along = n->variance * (1.0f - slant * slant) + between(forward, n, forward);
  const float depth = sqrt(2.0f * p.cutoff * along);
  const float half_depth = fmax(depth, sqrt(n->variance));
  s->z = z;
  s->z_near = z - half_depth;
  s->z_far = z + half_depth;
  if (!(size > 0.0f) || !(z - half_depth > p.near_units)) return false;

  const float towards = product(normal, from_eye);
  if (p.one_sided && !(towards < 0.0f)) return false;
  const float scale = p.focal_px / z, tan_x = x / z, tan_y = y / z;
  const float spread = scale * scale * (fabs(towards) / z);  // of a unit of area
  const float mass = spread * size;
  s->x = p.centre_x + p.focal_px * tan_x;
  s->y = p.centre_y + p.focal_px * tan_y;

  const float3 row_x = scale * (right - tan_x * forward);
  const float3 row_y = scale * (down - tan_y * forward);
  const float tilt_x = product(row_x, normal), tilt_y = product(row_y, normal);
  const float3 low =
      (float3)(between(row_x, n, row_x), between(row_x, n, row_y), between(row_y, n, row_y));
  const float coc = splat_coc(p, z);
  const bool is_disc =
      p.has_discs && fabs(coc) > DEFRAY_SPLAT_DISC * (1.0f + scale * sqrt(n->variance));
  const float blur = is_disc ? 0.25f * (coc * coc) : 0.36067376f * (coc * coc);  // 1 / (2 ln 4)
  const float4 added = circumellipse(low, blur);
  const float3 own = (float3)(n->variance * (product(row_x, row_x) - tilt_x * tilt_x),
                              n->variance * (product(row_x, row_y) - tilt_x * tilt_y),
                              n->variance * (product(row_y, row_y) - tilt_y * tilt_y));
  const float3 variance = (float3)(own.x + 1.0f + added.x, own.y + added.y, own.z + 1.0f + added.z);
  const float determinant = determinant_of(own, n->variance * spread, added);

  // A light at the eye: a third of it from all around.
  const float facing = fabs(towards) / sqrt(product(from_eye, from_eye));
  const float light = p.has_headlight ? 0.333333343f + 0.666666687f * facing : 1.0f;
  s->r = n->r * light;
  s->g = n->g * light;
  s->b = n->b * light;
  s->a = n->a;
  return mass > 0.0f && shape_splat(p, variance, determinant, mass, is_disc, s);
}

__kernel void splat_project(const DefraySplatParams p, __global const DefraySplatNode* nodes,
                            __global DefraySplat* splats) {
  const uint i = get_global_id(0);
  if (i >= p.count) return;
  DefraySplat s;
  s.x = s.y = s.conic_xx = s.conic_xy = s.conic_yy = s.amplitude = s.disc_px = 0.0f;
  s.r = s.g = s.b = s.a = 0.0f;
  if (!project_node(p, nodes + i, &s)) s.first_x = s.end_x = s.first_y = s.end_y = 0;
  splats[i] = s;
}
