// Faults of gather_literal, gather_aware, gather_tiles, gather_reach.
#include "faults/fault.h"

namespace defray::test::gather_faults {
namespace {

const FaultRows faults{
    {"gather_literal",
     "wrong border: no clamp to the last pixel",
     {"b = clamp(low + 1, 0, last)", "b = clamp(low, 0, last)"}},
    {"gather_literal",
     "truncated sum: last sample",
     {"k < p.sample_count; ++k", "k + 1 < p.sample_count; ++k"}},
    {"gather_literal", "off by half a pixel", {"whole_px(offset.x)", "whole_px(offset.x + 0.5f)"}},
    {"gather_literal",
     "places on the left rounded towards zero",
     {"select(towards_zero, towards_zero - 1, convert_float16(towards_zero) > places)",
      "towards_zero"}},
    {"gather_literal",
     "band's first row forgotten",
     {"(size_t)y * p.width + x;\n  const float16 radii",
      "(size_t)row * p.width + x;\n  const float16 radii"}},
    {"gather_literal",
     "turn's x and y swapped",
     {"pcg3d((uint3)(x + i, y, p.seed))", "pcg3d((uint3)(y, x + i, p.seed))"}},
    {"gather_aware",
     "nearer and farther swapped",
     {"d.own_coc - coc - 0.5f", "coc - d.own_coc - 0.5f"}},
    {"gather_aware",
     "near light within the pixel's own disc",
     {"nearer * covers(fabs(coc), distance)", "nearer * covers(d.own_radius, distance)"}},
    {"gather_aware", "pairs split without their centre", {"(i + odd) / 2u & 1u", "i / 2u & 1u"}},
    {"gather_aware", "disc's soft border not in its area", {"0.0833333358f", "0.0f"}},
    {"gather_aware",
     "near discs cover nothing",
     {"fmax(1.0f - sums.near_weight, (float16)(0.0f))", "(float16)(1.0f)"}},
    {"gather_aware",
     "wrong tile's reach",
     {"y / DEFRAY_GATHER_TILE * tiles_x + x / DEFRAY_GATHER_TILE", "x / DEFRAY_GATHER_TILE"}},
    {"gather_tiles",
     "last row dropped",
     {"min(y0 + DEFRAY_GATHER_TILE, p.height)", "min(y0 + DEFRAY_GATHER_TILE, p.height - 1u)"}},
    {"gather_tiles", "near radii forgotten", {"(int)abs(coc_quanta[", "(int)(coc_quanta["}},
    {"gather_reach",
     "gap one tile too wide",
     {"(int)abs(i - here) - 1, 0)", "(int)abs(i - here), 0)"}},
    {"gather_reach",
     "last tile in reach dropped",
     {"here + p.reach_tiles, tiles", "here + p.reach_tiles - 1, tiles"}},
    {"gather_reach", "exact reach does not count", {"<= theirs)", "< theirs)"}},
};

}  // namespace
}  // namespace defray::test::gather_faults
