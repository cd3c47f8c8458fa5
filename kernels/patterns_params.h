// Constants and parameter blocks of the kernels `patterns_*`, as in params.h.
#ifndef DEFRAY_KERNELS_PATTERNS_PARAMS_H
#define DEFRAY_KERNELS_PATTERNS_PARAMS_H
#include "params.h"

#ifdef __OPENCL_C_VERSION__
#define DEFRAY_ULONG ulong
#else
#define DEFRAY_ULONG std::uint64_t
#endif

/// What a pixel's word holds for `patterns` beside its 8-bit colour (r | g << 8 | b << 16).
#define DEFRAY_PATTERN_KNOWN (1u << 24)   ///< May be matched and copied.
#define DEFRAY_PATTERN_BEHIND (1u << 25)  ///< Has a synthesised fragment behind it.
/// Pairs are compared in cells of so many pixels a side, whose words hold their sum of squared
/// differences, at most 3 x 255^2 x 16 < 2^22, below KNOWN's bit and the number of pairs from it
/// on.
#define DEFRAY_PATTERN_CELL 4
/// Side n of the box whose square, convolved, weighs the cells of a window: weights add up to n^4
/// and 3 x 255^2 x 16 x 6^4 < 2^32.
#define DEFRAY_PATTERN_LARGEST_WINDOW 6
/// Cells that a work-item takes at once: those of a run of pixels. The plane of cells has so many
/// units more on each side: a unit's windows read 16 cells from up to 5 before its first on.
#define DEFRAY_PATTERN_UNIT (DEFRAY_RUN / DEFRAY_PATTERN_CELL)
#define DEFRAY_PATTERN_MARGIN 3
/// Closer pixels resemble each other on any smooth surface: no shift is shorter, px.
#define DEFRAY_PATTERN_LEAST 8

/// A shift of the picture for `patterns`.
typedef struct {
  DEFRAY_INT x;  ///< From a pixel to its match, px; if parallel, the longest.
  DEFRAY_INT y;
  float parallel;      ///< Not 0: through the scene along the picture, px where 1/depth is 1.
  float frame_square;  ///< Mean squared difference of the frame's pairs, (1/255)^2.
} DefrayPatternShift;

/// Rows of cells of a window of the frame, and all shifts: `patterns`.
typedef struct {
  DEFRAY_UINT width;      ///< Pixels in a row of the frame.
  DEFRAY_UINT height;     ///< Rows of the window.
  DEFRAY_INT first_row;   ///< First row of pixels of these cells, in the window.
  DEFRAY_UINT cell_rows;  ///< Rows of cells: those of matches and what windows reach.
  DEFRAY_UINT shift_count;
  DEFRAY_INT window_cells;       ///< Side n of the box whose square, convolved, weighs cells.
  DEFRAY_UINT tolerance_quanta;  ///< CoC radii that differ by no more are of one surface.
  DEFRAY_UINT channels;          ///< 1 to 4.
  float frame_pairs;             ///< What the frame's mean counts beside a window's pairs.
} DefrayPatternsParams;

/// Rows of a frame that are compared with the frame shifted: `patterns_agree`. Of a shift s those
/// from row max(0, -s.y) of the frame on, one of `row_step`.
typedef struct {
  DEFRAY_UINT width;     ///< Pixels in a row of the frame.
  DEFRAY_UINT height;    ///< Rows of the window.
  DEFRAY_INT above;      ///< Rows of the frame above the window.
  DEFRAY_INT first_row;  ///< In the window, of those that are compared.
  DEFRAY_INT end_row;    ///< Below them.
  DEFRAY_INT part_rows;  ///< Of them, those that a work-item takes.
  DEFRAY_INT row_step;   ///< At least 1.
  DEFRAY_UINT shift_count;
  DEFRAY_INT tolerance_quanta;  ///< CoC radii that differ by no more are of one surface.
} DefrayAgreeParams;

/// How well pixels agree with others. Of a work-item fewer than 2^32 / (3 x 255^2) are compared in
/// each lane of a run.
typedef struct {
  DEFRAY_ULONG squares;  ///< Of differences of 8-bit colours, all three together.
  DEFRAY_ULONG pairs;    ///< Of known pixels of one surface.
} DefrayAgreement;
/// Rows that a work-item takes times runs of a row are no more.
#define DEFRAY_AGREE_RUNS 16384

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DefrayAgreeParams) == 36);
static_assert(sizeof(DefrayAgreement) == 16);
static_assert(sizeof(DefrayPatternShift) == 16);
static_assert(sizeof(DefrayPatternsParams) == 36);
#endif

#endif
