// assemble: what is in front and what lies behind, as the two layers of one frame.
//
// front_coc, behind_coc            [height][width]          signed radius, 1/256 px
// front_inverse, behind_inverse    [height][width]          1/depth; 0: background; negative: no
//                                                           surface
// front_coverage, behind_coverage  [height][width]          2^-16 of the pixel, and flags
// front0..3, behind0..3            [height][width]          colour
// coc_quanta                       [height][2][width]
// depth                            [height][2][width]       DEFRAY_EMPTY's bits: no surface
// coverage                         [height][2][width]       0: no surface; what lies in the margin
//                                                           was not seen
// channel0..3                      [height][2][width]
// Global size: (width, 2 height).
#include "colour.clh"
#include "frame.clh"

__kernel void assemble(const DefrayAssembleParams p, __global const int* restrict front_coc,
                       __global const float* restrict front_inverse,
                       __global const uint* restrict front_coverage, CHANNEL_PARAMETERS(front),
                       __global const int* restrict behind_coc,
                       __global const float* restrict behind_inverse,
                       __global const uint* restrict behind_coverage, CHANNEL_PARAMETERS(behind),
                       __global int* restrict coc_quanta, __global float* restrict depth,
                       __global uint* restrict coverage, WRITTEN_CHANNELS(channel)) {
  const uint x = get_global_id(0), row = get_global_id(1);
  if (x >= p.width || row >= 2u * p.height) return;
  const bool is_front = row % 2u == 0u;
  const uint y = p.first_row + row / 2u;
  const uint from = row / 2u * p.width + x, to = row * p.width + x;
  const float inverse = is_front ? front_inverse[from] : behind_inverse[from];
  const uint share = is_front ? front_coverage[from] : behind_coverage[from];
  const bool is_in_margin =
      x < p.margin || x + p.margin >= p.width || y < p.margin || y + p.margin >= p.frame_height;
  const float z = inverse == 0.0f ? INFINITY : 1.0f / inverse;
  depth[to] = inverse < 0.0f ? as_float(DEFRAY_EMPTY) : z;
  coverage[to] = inverse < 0.0f ? 0u : share | (is_in_margin ? DEFRAY_SYNTHESISED : 0u);
  coc_quanta[to] = is_front ? front_coc[from] : behind_coc[from];
  const float4 colour =
      is_front ? colour_at(CHANNELS(front), from) : colour_at(CHANNELS(behind), from);
  set_colour(CHANNELS(channel), to, colour);
}
