// Parameter blocks of `splat_project` and `splat_resolve`, as in params.h.
#ifndef DEFRAY_KERNELS_SPLAT_PARAMS_H
#define DEFRAY_KERNELS_SPLAT_PARAMS_H
#include "params.h"

/// Side of the square tiles that splats are sorted into, in pixels, and of a work-item's squares.
#define DEFRAY_SPLAT_TILE 8
#define DEFRAY_SPLAT_SQUARE 4
#define DEFRAY_SPLAT_SQUARES (DEFRAY_SPLAT_TILE * DEFRAY_SPLAT_TILE / 16)
/// A disc's square radius over a splat's own variance: from here on its blur is a disc, where discs
/// are asked for, and below a Gaussian is as near to what it should be.
#define DEFRAY_SPLAT_DISC 4.74f
/// A pixel that lets less through is opaque.
#define DEFRAY_SPLAT_OPAQUE 0.000244140625f

/// Ridges at which a surface ends beside a point, at most: at a face's corner two.
#define DEFRAY_SPLAT_RIDGES 2

/// From a point along its surface to the nearest place of a straight ridge; nothing: none.
typedef struct {
  float x, y, z;
} DefraySplatRidge;

/// A point of a cloud, or a node of its hierarchy that stands for many: what `splat_project` reads.
/// Places are in scene units from the cloud's origin. Krivanek & Zara 2003, section 5.3.
typedef struct {
  float x, y, z;
  float area_x, area_y, area_z;  ///< The normal, as long as the area that it stands for.
  float variance;                ///< Of the basis function, along the surface: V_r.
  /// V_q: the covariance of the places that a node stands for; 0 of a point.
  float low_xx, low_xy, low_xz, low_yy, low_yz, low_zz;
  float cover;       ///< Where it is sharp it covers so many times its area, so that no holes show.
  float both_sides;  ///< Share of its area that is seen from both sides; above 1/2 all of it is.
  float r, g, b, a;  ///< Premultiplied.
  DEFRAY_UINT ridges;  ///< Which set of DEFRAY_SPLAT_RIDGES, of points beside some; else 0.
} DefraySplatNode;

/// How much of a splat is on its side of a ridge: at + x dx + y dy, px from its centre, within
/// [least, 1].
typedef struct {
  float at, x, y, least;
} DefraySplatLine;

/// A node's resampling kernel in the picture.
typedef struct {
  float x, y;                                 ///< Centre, px.
  float conic_xx, conic_xy, conic_yy;         ///< 1/2 d^T W^-1 d; of discs d^T (D W)^-1 d.
  float amplitude;                            ///< At the centre.
  float disc_top;                             ///< 0: Gaussian; else where a disc's conic ends.
  float disc_bulge;                           ///< How steeply a disc falls: 0 to 2.
  float lean_x, lean_y;                       ///< Of the amplitude, per px.
  float back;                                 ///< Of what is below 0: 0 nothing is seen, -1 all.
  float z;                                    ///< Depth, scene units.
  float z_near, z_far;                        ///< Of the basis function.
  DEFRAY_INT first_x, end_x, first_y, end_y;  ///< Pixels within the cut-off; none: culled.
  float r, g, b, a;
  DEFRAY_UINT lines;  ///< Which set of DEFRAY_SPLAT_RIDGES; 0: none.
} DefraySplat;

/// Camera and lens of `splat_project`, and how splats become pixels in `splat_resolve`.
typedef struct {
  DEFRAY_UINT count;  ///< Nodes, or splats.
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  float right_x, right_y, right_z;  ///< The picture's axes in the scene.
  float down_x, down_y, down_z;
  float forward_x, forward_y, forward_z;
  float eye_x, eye_y, eye_z;  ///< The lens's centre, from the cloud's origin.
  float near_units;           ///< What comes nearer is not seen.
  float focal_px;
  float centre_x, centre_y;    ///< Where the axis meets the picture, px.
  float coc_scale_px;          ///< K: coc(z) = K (z - z0) / z.
  float focus_units;           ///< z0; with focus_is_infinite unused.
  float infinite_focus_scale;  ///< coc(z) = -scale / z.
  float lens_units;            ///< The lens's radius.
  DEFRAY_UINT focus_is_infinite;
  float limit_px;             ///< Largest CoC radius let through.
  float cutoff;               ///< c: where 1/2 d^T W^-1 d reaches it, a Gaussian ends.
  float edge;                 ///< e^-c, which Gaussians are lowered by: they end at 0.
  float gaussian_share;       ///< 1 - e^-c (1 + c): what is then left of one.
  float gaussian_variance;    ///< And of its variance: 1 - c^2 e^-c / 2 over that share.
  float aim;                  ///< Weights are so many times larger, for sums that are less even.
  DEFRAY_UINT one_sided;      ///< 1: surfaces with one side are seen from where normals point.
  DEFRAY_UINT has_discs;      ///< 1: what is mostly blur becomes a disc.
  DEFRAY_UINT has_headlight;  ///< 1: colours are shaded by a light at the eye.
  DEFRAY_UINT averages;       ///< 1: a surface's fragments are averaged; 0: the nearest count.
  DEFRAY_INT layers;          ///< Surfaces that a pixel is made of, at most.
} DefraySplatParams;

/// A group of tiles of `splat_resolve`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  DEFRAY_UINT tiles_x;
  DEFRAY_UINT first_tile;
  DEFRAY_UINT tile_count;
  float cutoff;
  float edge;
  DEFRAY_UINT averages;
  DEFRAY_INT layers;
} DefraySplatTileParams;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DefraySplatNode) == 80);
static_assert(sizeof(DefraySplat) == 92);
static_assert(sizeof(DefraySplatParams) == 140);
static_assert(sizeof(DefraySplatTileParams) == 36);
#endif

#endif
