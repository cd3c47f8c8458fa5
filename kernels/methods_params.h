// Constants and parameter blocks of the kernels in methods/, as in params.h.
#ifndef DEFRAY_KERNELS_METHODS_PARAMS_H
#define DEFRAY_KERNELS_METHODS_PARAMS_H
#include "params.h"

/// Side of the square tiles whose largest CoC `gather_reach` finds, in pixels.
#define DEFRAY_GATHER_TILE 16
/// Angles of the rotated sample set: a table, so that no device's sine matters.
#define DEFRAY_GATHER_ROTATIONS 64

/// One band of target rows of `linear`. Its source planes are those of a window: the band and the
/// rows in reach, with the columns in reach beside them, where the frame's edge pixels repeat.
typedef struct {
  DEFRAY_UINT width;  ///< Target pixels in a row.
  DEFRAY_UINT window_rows;
  DEFRAY_UINT band_row;  ///< First target row, in the window.
  DEFRAY_UINT band_rows;
  DEFRAY_UINT source_stride;  ///< Floats from one source row to the next.
  DEFRAY_INT reach;           ///< Columns of source on each side of the targets'; rows likewise.
} DefrayLinearParams;

/// The CoC of a tilt-shift: 0 in a horizontal band, growing linearly away from it.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT rows;
  float first_row_px;         ///< Display-window row of the first data row.
  float band_centre_px;       ///< From the display window's top.
  float half_band_px;         ///< Half the height of the sharp band.
  float slope_quanta_per_px;  ///< Growth of the radius beyond the band.
  float limit_quanta;         ///< Its end: data may lie beyond the frame's edge.
} DefrayTiltshiftParams;

/// A Poisson-disk gather over one band of target rows, from a window: the band and the rows in
/// reach.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT window_y;  ///< First source row, in frame coordinates.
  DEFRAY_UINT window_rows;
  DEFRAY_UINT band_y;  ///< First target row, in frame coordinates.
  DEFRAY_UINT band_rows;
  DEFRAY_UINT sample_count;
  DEFRAY_UINT rotates;  ///< 1: each pixel turns the sample set by an angle of its own.
  DEFRAY_UINT seed;
  float radius_scale;  ///< CoC radii are multiplied by this: a pass's share of the blur.
} DefrayGatherParams;

/// Tiles of a frame for `gather_tiles` and `gather_reach`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  DEFRAY_UINT tiles_x;
  DEFRAY_UINT tiles_y;
  DEFRAY_INT reach_tiles;  ///< Tiles on each side from which a CoC can reach a tile.
  DEFRAY_UINT along_y;     ///< gather_reach: 0 looks along x, 1 along y.
} DefrayTileParams;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DefrayLinearParams) == 24);
static_assert(sizeof(DefrayTiltshiftParams) == 28);
static_assert(sizeof(DefrayGatherParams) == 36);
static_assert(sizeof(DefrayTileParams) == 24);
#endif

#endif
