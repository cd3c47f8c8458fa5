// Parameter blocks that kernels (OpenCL C) and host (C++) both read: data is shared, arithmetic
// never. Every field is four bytes wide, so that the layout is the same in both languages.
#ifndef DEFRAY_KERNELS_PARAMS_H
#define DEFRAY_KERNELS_PARAMS_H

#ifdef __OPENCL_C_VERSION__
// Contraction off, in all kernels: a * b + c rounds twice, as in their twins.
#ifndef DEFRAY_FAST_MATH
#pragma OPENCL FP_CONTRACT OFF
#endif
#define DEFRAY_UINT uint
#define DEFRAY_INT int
#else
#include <cstdint>
#define DEFRAY_UINT std::uint32_t
#define DEFRAY_INT std::int32_t
#endif

/// Signed CoC radii are integers in units of 2^-8 px (the CoC quantum, 1/256 px).
#define DEFRAY_COC_FRACTION_BITS 8
/// Lens coordinates are integers in units of 2^-16 of the aperture radius.
#define DEFRAY_LENS_FRACTION_BITS 16
/// Largest CoC radius in quanta: 2^22 px. A frame is at most 2^16 px wide and the smallest lens
/// coordinate of a 64x64 RDB is 1/64, so rays off the lens centre have left the frame before it.
#define DEFRAY_COC_LIMIT_QUANTA (1 << 30)
/// A cell that no ray has reached: both halves of its (depth, source) key. As depth: no fragment.
#define DEFRAY_EMPTY 0xffffffffu
/// Pixels of a row that a work-item takes at once, as one vector, in `mixed`, `fill`, `repair`,
/// `feather`, `soften`, `linear` and the gathers.
#define DEFRAY_RUN 16
/// A fragment that covers its whole pixel.
#define DEFRAY_WHOLE 65536u
/// Flag in a fragment's coverage: the picture did not show it, it was made up.
#define DEFRAY_SYNTHESISED 0x80000000u

/// A step of the CoC from one pixel to the next that parts their rays by more than 3/4 of a pixel:
/// one surface ends there and another goes on behind it. Of 0.5, 0.75, 0.875 and 1 px: random
/// layers (defray-perf experiment layered, 50 scenes) gain 0.3, 0.37, 0.06, 0 dB in the mean;
/// built-in scenes lose up to 1.1 dB at 0.5 (lines), 0.1 at 0.75, and gain 0.1 (plate1, blocks).
#define DEFRAY_JUMP_QUANTA 192
/// A step that parts no surfaces, up to a ramp's, differs by so much from that before or after it.
/// Of 32, 64 and 96 all give `slanted` at 300 mm f/0.5 (1.2 px a pixel) 1.2 dB more, and change no
/// other built-in scene by more than 0.001 dB; 96 forgives half floats the most.
#define DEFRAY_BEND_QUANTA 96
/// A step up to this one may be of one surface whatever those around it (span.clh). Of 0, 16 and 40
/// none changes the built-in scenes by more than 0.03 dB; where every step up to a jump's went on
/// blocks gained 0.1 dB at 640x400, and `cutout` lost 0.8 at 96x72, where shapes are close in CoC.
#define DEFRAY_SMALL_STEP_QUANTA 16
/// Depth is anti-aliased across steps of the CoC above this (2 px), or it does not matter.
#define DEFRAY_RAMP_QUANTA 512
/// Of a pixel whose depth lies between two surfaces' `repair` says which pixel has that of the
/// nearer one in CoC, up to 2 px away along each axis, as 1 + (2 + dx) + 5 (2 + dy); and, with this
/// flag, that its colour is a mean of theirs, too.
#define DEFRAY_RAMP_MIXES 32u
/// CoC radii count as no larger than this where differences are taken: 2^20 px.
#define DEFRAY_TAME_QUANTA (1 << 28)
/// What `fill` is told of a pixel: it is mixed, a silhouette goes on there behind what hides it.
#define DEFRAY_MIXED 1u
#define DEFRAY_SILHOUETTE 2u
/// Side of the square tiles in which `fill` may have something to do, in pixels: whole runs.
#define DEFRAY_FILL_TILE 16
/// Side of the square cells that say how far around a run no pixel is mixed, in pixels.
#define DEFRAY_FILL_CELL 4
/// A tile for which `fill` has nothing to do: nearer than every CoC.
#define DEFRAY_NOTHING_BEHIND (-0x7fffffff)
/// A surface that lies farther by less than this part of how much the one in front is blurred does
/// not show behind it for `fill`: all that does is a rim, so much narrower than its own blur, but
/// what is made up is one layer, and would lack the surfaces beyond (bars that cross, blurred by
/// 350 px before a sharp wall, left dark squares there). Up to 48 px of blur any surface shows that
/// is parted at all.
#define DEFRAY_FILL_BLUR_TO_RISE 64
/// So many of the first pixels of what `fill` meets may be mixed.
#define DEFRAY_FILL_MIXED 3
/// Beyond the first pure one it looks at so many pixels, each so many further on than the last: at
/// how colours go on, and at the slant, which the first of them tells.
#define DEFRAY_FILL_LOOKS 4
#define DEFRAY_FILL_LOOK_PX 4
/// And at one on either side of the way, so far from it and so far beyond the first: whether the
/// way follows a line or an edge. (2 and 3 px to either side: as near to the truth.)
#define DEFRAY_FILL_SIDE_PX 3
#define DEFRAY_FILL_SIDES_AT_PX 2
/// Most directions in which `fill` looks for what goes on behind.
#define DEFRAY_FILL_DIRECTIONS 16
/// So far `split` takes surfaces from: squares of 7 px.
#define DEFRAY_SPLIT_PX 3
/// So far along a thin thing it looks for more of its colour (5, 8 and 12 px at 640x400: garden
/// grass 35.84, 35.87, 35.86 dB).
#define DEFRAY_SPLIT_THIN_PX 8
/// So far `feather` takes colours from, weighed by DEFRAY_FEATHER_WEIGHT less the squared distance.
/// Of 1, 2 and 3 px (640x400) `cutout` far loses 0.10, 0.18 and 0.42 dB; plate1 gains up to 0.06.
#define DEFRAY_FEATHER_PX 2
#define DEFRAY_FEATHER_WEIGHT ((DEFRAY_FEATHER_PX + 1) * (DEFRAY_FEATHER_PX + 1))
/// Most samples a side of the square over which `soften` averages.
#define DEFRAY_SOFTEN_TAPS 7

/// How much brighter than its surroundings a highlight is, and how much one that is so as a whole:
/// between them a growing share of its light is. Rays through n cells show a source as dots of 1/n
/// of its brightness: up to here they are fainter than a hundredth or two.
#define DEFRAY_HIGHLIGHT 7.0f
#define DEFRAY_HIGHLIGHT_WHOLE 13.0f
/// Side of the square tiles whose darkest surroundings `highlights` knows, in pixels.
#define DEFRAY_HIGHLIGHT_TILE 16
/// Below this CoC (1 px) rays may land as those of another radius do.
#define DEFRAY_SMALL_QUANTA 256
/// Below this CoC (half a pixel) a fragment's rays stay in its pixel, but for a few.
#define DEFRAY_SHARP_QUANTA 128
/// Side of the square tiles that highlights are sorted into, in pixels.
#define DEFRAY_LIGHT_TILE 32
/// Neighbouring highlights that are one source, pixels a side at most; and what a source's rows
/// count beside its columns.
#define DEFRAY_LIGHT_GROUP 4
#define DEFRAY_LIGHT_ROW 256
/// Entries a side of the aperture's summed-area table: one more than texels.
#define DEFRAY_APERTURE_TABLE 513
/// Largest side of a source's map of the lens: smaller discs have an entry a pixel.
#define DEFRAY_LIGHT_MAP 64

/// No fragment, in the padded planes of `rdb_gather`: beyond every CoC.
#define DEFRAY_NO_KEY 0x7fffffff
/// One work-item of `rdb_gather`: so many pixels of a row, as one vector, and rows.
#define DEFRAY_RAY_RUN 16
#define DEFRAY_RAY_ROWS 4
/// Side of the square tiles whose CoC radii are known to `rdb_gather`, in pixels, and the bins in
/// which it knows them: words of 64.
#define DEFRAY_RAY_TILE 16
#define DEFRAY_RAY_WORDS 4
#define DEFRAY_RAY_BINS (64 * DEFRAY_RAY_WORDS)

/// Thin-lens constants of `coc`.
typedef struct {
  DEFRAY_UINT pixel_count;
  DEFRAY_UINT focus_is_infinite;  ///< 1: coc = -infinite_focus_scale / depth.
  float scale_quanta;             ///< K = A F / (2 z0), in quanta; 0 for focus at infinity.
  float focus_hi_units;           ///< Focus distance z0 = hi + lo, scene units.
  float focus_lo_units;           ///< What float rounding takes from z0.
  float infinite_focus_scale;     ///< A F / 2, in quanta x scene units.
  float limit_quanta;             ///< Largest |coc| let through.
} DefrayCocParams;

/// One pass of the ray distribution buffer: some cells of one band of target rows.
/// The source window is the band and the rows around it from which a ray can reach it.
typedef struct {
  DEFRAY_UINT width;     ///< Pixels in a row, of source and target.
  DEFRAY_UINT window_y;  ///< First source row, in frame coordinates.
  DEFRAY_UINT window_rows;
  DEFRAY_UINT band_y;  ///< First target row, in frame coordinates.
  DEFRAY_UINT band_rows;
  DEFRAY_UINT first_cell;     ///< First lens point of this pass.
  DEFRAY_UINT cell_count;     ///< Lens points in this pass.
  DEFRAY_UINT is_first_pass;  ///< 1: sums start at zero.
  DEFRAY_UINT is_last_pass;   ///< 1: sums become means.
  DEFRAY_UINT is_index_pass;  ///< 1: second of two scatters, without 64-bit atomics.
  DEFRAY_INT jitter_lens;     ///< Largest jitter offset, lens units; 0: no jitter.
  DEFRAY_UINT seed;
  DEFRAY_UINT layers;        ///< Fragments a pixel: planes of sources are [row][layer][width].
  DEFRAY_UINT has_coverage;  ///< 0: every fragment is whole and was seen.
  DEFRAY_INT origin_x;       ///< Of the frame in the display window: what is random follows it.
  DEFRAY_INT origin_y;
  DEFRAY_UINT has_rim;            ///< 1: the lens's rim cuts off cells, see rim.clh.
  DEFRAY_UINT all_cells;          ///< Lens points of all passes.
  DEFRAY_UINT has_data_of;        ///< 0: every fragment has data of its own (`rdb_nearest`).
  DEFRAY_UINT has_landing_radii;  ///< 0: rays of all radii land as their own (`rdb_scatter`).
  DEFRAY_UINT has_spans;          ///< 1: fragments are pieces of a surface, see span.clh.
  DEFRAY_UINT winner_words;       ///< 2: source and key (`rdb_scatter`); 1: the source alone.
} DefrayRdbParams;

/// The rays of a window's pixels, from where they end: `rdb_pad`, `rdb_tiles`, `rdb_reach`,
/// `rdb_gather`. Tiles are counted from the window's corner.
typedef struct {
  DEFRAY_UINT width;     ///< Pixels in a row, of source and target.
  DEFRAY_UINT layers;    ///< Fragments a pixel.
  DEFRAY_UINT channels;  ///< 1 to 4.
  DEFRAY_UINT window_y;  ///< First source row, in frame coordinates.
  DEFRAY_UINT window_rows;
  DEFRAY_UINT stride;    ///< Pixels in a row of padded planes.
  DEFRAY_UINT band_x;    ///< First target column, a multiple of DEFRAY_RAY_TILE.
  DEFRAY_UINT band_end;  ///< One past the last target column.
  DEFRAY_UINT band_y;    ///< First target row, in frame coordinates.
  DEFRAY_UINT band_rows;
  DEFRAY_UINT first_cell;     ///< First lens point of this pass.
  DEFRAY_UINT cell_count;     ///< Lens points in this pass.
  DEFRAY_UINT is_first_pass;  ///< 1: sums start at zero.
  DEFRAY_UINT is_last_pass;   ///< 1: sums become means.
  DEFRAY_UINT tiles_x;
  DEFRAY_UINT tiles_y;
  DEFRAY_INT reach_tiles;  ///< Tiles on each side from which a CoC can reach a tile.
  DEFRAY_UINT along_y;     ///< rdb_reach: 0 looks along x, 1 along y.
  DEFRAY_INT
  first_bin;  ///< Radii from first_bin << bin_shift on are in bin 0, as are smaller ones.
  DEFRAY_UINT bin_shift;
  DEFRAY_UINT has_coverage;  ///< 0: every fragment is whole and was seen.
  DEFRAY_UINT has_rim;       ///< 1: the lens's rim cuts off cells, see rim.clh.
  DEFRAY_UINT has_spans;     ///< 1: fragments are pieces of a surface, see span.clh.
  DEFRAY_INT origin_x;       ///< Of the frame in the display window: what is random follows it.
  DEFRAY_INT origin_y;
  DEFRAY_UINT wants_winners;  ///< 1: `rdb_nearest` does.
} DefrayRaysParams;

/// A whole frame: `repair`, `mixed`, `feather`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
} DefrayFrameParams;

/// Mixed pixels taken apart: `split`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;     ///< Rows of the window.
  DEFRAY_UINT first_row;  ///< Of the window, in the frame.
  DEFRAY_UINT frame_height;
  DEFRAY_UINT margin;  ///< Columns and rows around the picture, which were not seen.
} DefraySplitParams;

/// What lies behind: `fill`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  DEFRAY_UINT tiles_x;
  DEFRAY_UINT directions;  ///< 8, or DEFRAY_FILL_DIRECTIONS.
} DefrayFillParams;

/// Colours averaged over what one lens point sees: `soften`.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  DEFRAY_UINT layers;
  float cells_per_side;  ///< Of a square grid around the lens as dense as its points.
} DefraySoftenParams;

/// Which fragments are highlights.
typedef struct {
  DEFRAY_UINT width;
  DEFRAY_UINT height;
  DEFRAY_UINT layers;
  DEFRAY_UINT light_channels;  ///< 1 to 4, alpha apart.
  DEFRAY_UINT tiles_x;
} DefrayHighlightParams;

/// Their light, for a pass of the RDB.
typedef struct {
  DEFRAY_UINT tiles_x;
  float share_of_light;  ///< 1 / the aperture table's total.
} DefrayLightParams;

/// What of the lens sees them: `light_maps`.
typedef struct {
  DEFRAY_UINT sources;
  DEFRAY_UINT width;
  DEFRAY_UINT layers;
  DEFRAY_UINT window_y;  ///< First source row, in frame coordinates.
  DEFRAY_UINT window_rows;
  DEFRAY_UINT has_coverage;
} DefrayLightMapParams;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DefrayHighlightParams) == 20);
static_assert(sizeof(DefrayLightParams) == 8);
static_assert(sizeof(DefrayLightMapParams) == 24);
static_assert(sizeof(DefrayFrameParams) == 8);
static_assert(sizeof(DefraySplitParams) == 20);
static_assert(sizeof(DefrayFillParams) == 16);
static_assert(sizeof(DefraySoftenParams) == 16);
static_assert(sizeof(DefrayCocParams) == 28);
static_assert(sizeof(DefrayRdbParams) == 88);
static_assert(sizeof(DefrayRaysParams) == 104);
#endif

#endif
