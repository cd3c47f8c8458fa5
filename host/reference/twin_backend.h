#pragma once
// The scalar twins: every kernel once more. They define what a kernel must compute; they run where
// there is no device. Floats are added in the kernels' order: equal bits.
//
// A twin written from a definition sees a wrong idea in its kernel; one that goes the kernel's way
// in other words sees slips alone, and there a test derives the result a second time
// (tests/kernels):
//   from the papers    coc, rdb_* (each target asks every source), linear, gather_literal
//                      and tiltshift
//   from a definition  patterns (whole windows), patterns_agree (pair by pair), gather_reach
//                      (each tile against each), rdb_between (its rows in a list)
//   the kernel's way   mixed, repair    mixed_test: steps and slopes drawn with known answers
//                      fill             fill_test, stage_oracles_test: planes, slants and stripes
//                                       that must go on
//                      split            split_test: coverage and colours mixed by hand come back;
//                                       stage_oracles_test: shares sought, not computed
//                      soften           soften_test: overlaps of squares, in double
//                      highlights*      highlight_disc_test: exact areas of polygons; lamp_test
//                      gather_aware     gather_test: variances, what must stay clean
// Neither sees what device and twins share: chain/ (border, layers, light taken, shifts found and
// blended), rdb/sparse_tiles and lens/ (apertures, samples). There tests have oracles of their own:
// picture_floor_test (ray-traced truths), lamp_test (energy and place), border_test, rim_test,
// patterns_picture_test, *_search_test, chain_parts_test, layers_test,
// sparse_test. chain_stages_test holds the stages of whole pictures against their twins.
#include <cstdint>
#include <vector>

#include "chain/patterns/patterns.h"
#include "frame/backend.h"
#include "methods/gather.h"

namespace defray::reference {

class TwinBackend : public Backend {
 public:
#define DEFRAY_CALL(Result, name, parameters) Result name parameters override;
#include "frame/backend.def"
#undef DEFRAY_CALL
};

}  // namespace defray::reference
