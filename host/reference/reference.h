#pragma once
// The scalar twins: every kernel once more, written from the papers' formulas and not from the
// kernels. They define what a kernel must compute; they run where there is no Session.
#include <cstdint>
#include <functional>
#include <vector>

#include "chain/patterns.h"
#include "lens/lens.h"
#include "lens/lens_cells.h"
#include "methods/gather.h"
#include "rdb/rdb.h"

namespace defray::reference {

/// Signed CoC radius in pixels of a point at planar depth z > 0 (anything else: background), exact
/// to a few double roundings, before any limit.
double coc_px(const Lens& lens, int display_width_px, double depth_units);

/// Twin of kernel `coc`: radii limited and rounded to quanta of 1/256 px.
std::vector<std::int32_t> coc(const Lens& lens, int display_width_px, const Plane& depth);

/// Twin of kernel `rdb_scatter` for one lens cell over the whole frame: index of the nearest
/// fragment whose ray arrives at each target pixel, or -1.
std::vector<std::int64_t> rdb_scatter(const FragmentView& fragments, const RdbSettings& settings,
                                      const LensCells& cells, std::size_t cell);

/// Twins of `rdb_scatter` and `rdb_merge`, summed in float and in the kernel's order: equal bits.
/// With light sources, the twin of `highlights_add` too; if wanted, that of `rdb_nearest`.
RdbResult distribute_rays(const FragmentView& fragments, const RdbSettings& settings,
                          const LightSources* lights = nullptr,
                          const std::function<void(double)>& progress = {});

/// Twin of kernel `highlights`.
Plane highlights(const Fragments& fragments, int light_channels);

/// Twin of kernel `highlights_add`: adds the light to the means. `winner` holds every cell's
/// winners, [cell][pixel], -1 where no ray arrives.
void add_light(const LightSources& lights, const FragmentView& fragments,
               const RdbSettings& settings, const std::vector<std::vector<std::int32_t>>& winner,
               std::vector<Plane>& means);

/// The lens picture of whole pixels.
std::vector<Plane> render_rdb(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                              const Plane& depth, const std::vector<Plane>& channels,
                              const RdbSettings& settings,
                              const std::function<void(double)>& progress = {});

/// The same means without float's rounding, cells simply added up: what rounding is measured
/// against.
std::vector<std::vector<double>> exact_rdb(const FragmentView& fragments,
                                           const RdbSettings& settings);

/// Twin of kernel `linear_psf` with its preparation, edge pixels repeated outside the frame. Real
/// float adds in the kernel's order: equal bits. Real double is what rounding is measured against.
template <typename Real>
std::vector<std::vector<Real>> render_linear(int width, int height,
                                             const std::vector<std::int32_t>& coc_quanta,
                                             const std::vector<Plane>& channels);

/// Twin of kernel `tiltshift`.
std::vector<std::int32_t> tiltshift(const DefrayTiltshiftParams& p);

/// Twin of kernel `gather_tiles`.
std::vector<std::int32_t> gather_tiles(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta);

/// Twin of kernel `gather_reach`, both its runs: each tile against each.
std::vector<std::int32_t> gather_reach(int width, int height,
                                       const std::vector<std::int32_t>& coc_quanta);

/// Twins of kernels `gather_literal` and `gather_aware`: one pass over a frame, in float and in the
/// kernels' order: equal bits.
std::vector<Plane> gather_literal(const DefrayGatherParams& p, const GatherSamples& samples,
                                  const std::vector<std::int32_t>& coc_quanta,
                                  const std::vector<Plane>& channels);
std::vector<Plane> gather_aware(const DefrayGatherParams& p, const GatherSamples& samples,
                                const std::vector<std::int32_t>& coc_quanta,
                                const std::vector<Plane>& channels);

/// All passes.
std::vector<Plane> render_gather(int width, int height, const std::vector<std::int32_t>& coc_quanta,
                                 const std::vector<Plane>& channels,
                                 const GatherSettings& settings);

/// Twin of kernel `patterns_difference`.
std::vector<std::uint32_t> pattern_difference(const PatternFrame& frame,
                                              const std::vector<std::uint32_t>& pixels,
                                              PatternShift shift, const PatternSettings& settings);

/// Twin of kernel `patterns_columns`.
std::vector<std::uint64_t> pattern_columns(const PatternFrame& frame,
                                           const std::vector<std::uint32_t>& pixels,
                                           PatternShift shift, const PatternSettings& settings);

/// Twin of all three, `patterns_match` the last, for one shift after the other: equal bits.
PatternSums match_patterns(const PatternFrame& frame, const std::vector<std::uint32_t>& pixels,
                           const std::vector<Plane>& channels, const std::vector<Plane>& behind,
                           const std::vector<PatternShift>& shifts,
                           const PatternSettings& settings);

/// The whole stage with the twins.
void improve_by_patterns(const PatternFrame& frame, const std::vector<Plane>& channels,
                         const PatternSettings& settings, std::vector<Plane>& behind);

}  // namespace defray::reference
