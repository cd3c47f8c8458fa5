#pragma once
// Parts of the scalar twins by themselves, and exact arithmetic to measure rounding against. Which
// twins are independent of their kernels, and what stands in where one is not: twin_backend.h.
#include <cstdint>
#include <vector>

#include "chain/patterns/patterns.h"
#include "frame/frame.h"
#include "lens/lens.h"
#include "methods/gather.h"
#include "rdb/light_sources.h"
#include "rdb/ray_tiles.h"
#include "rdb/rdb.h"

namespace defray::reference {

/// Signed CoC radius in pixels of a point at planar depth z > 0 (anything else: background), exact
/// to a few double roundings, before any limit.
double coc_px(const Lens& lens, int display_width_px, double depth_units);

/// CoC radii, quanta.
struct Span {
  std::int32_t least, largest;
};

/// Twin of kernels/rdb/span.clh: half way to the pixels around that go on a fragment's surface; its
/// own radius alone where the plan has no spans.
Span span_of(const Frame& frame, const RayPlan& plan, std::size_t surface);

/// Twin of kernel `rdb_scatter` for one lens point over the whole frame: index of the nearest
/// surface whose ray arrives at each target pixel, or -1.
std::vector<std::int64_t> rdb_scatter(const Frame& frame, const RayPlan& plan, std::size_t cell);

/// Twins of kernels `rdb_pad`, `rdb_tiles` and `rdb_reach` over a whole frame: each bin by its
/// radii, each tile against each.
RayTiles ray_tiles(const Frame& frame, const RayPlan& plan);

/// Twin of kernel `rdb_between`, over the picture; `sparsity` of all tiles of the frame.
void rdb_between(const Frame& frame, const std::vector<std::uint32_t>& sparsity, RayResult& out);

/// Twin of kernel `light_maps`: all maps, one after the other.
std::vector<std::uint8_t> light_maps(const LightSources& lights, const Frame& frame);

/// Twin of kernel `highlights_add`, `light_maps` before it: adds the light to the means.
void highlights_add(const LightSources& lights, const Frame& frame, const RayPlan& plan,
                    std::vector<Plane>& means);

/// The means of rays without float's rounding, cells simply added up.
std::vector<std::vector<double>> exact_rays(const Frame& frame, const RayPlan& plan);

/// Twin of kernel `linear_psf` with its preparation, edge pixels repeated outside the frame. Real
/// float adds in the kernel's order: equal bits. Real double is what rounding is measured against.
template <typename Real>
std::vector<std::vector<Real>> linear(const Frame& frame);

/// Twin of kernel `gather_tiles`.
std::vector<std::int32_t> gather_tiles(const Frame& frame);

/// Twin of kernel `gather_reach`, both its runs: each tile against each.
std::vector<std::int32_t> gather_reach(const Frame& frame);

/// Twins of kernels `gather_literal` and `gather_aware`: one pass over a frame.
std::vector<Plane> gather_literal(const DefrayGatherParams& p, const GatherSamples& samples,
                                  const std::vector<Plane>& channels, const Frame& frame);
std::vector<Plane> gather_aware(const DefrayGatherParams& p, const GatherSamples& samples,
                                const std::vector<Plane>& channels, const Frame& frame);

/// Twin of kernel `patterns_difference`: [shifts][rows of cells][pattern_row_words].
std::vector<std::uint32_t> patterns_difference(const Frame& frame, const Words& pixels,
                                               const std::vector<PatternShift>& shifts,
                                               const PatternSettings& settings);

}  // namespace defray::reference
