// The checks of kernels rdb_*.
#include <algorithm>
#include <utility>

#include "rdb/rdb_plan.h"
#include "reference/reference.h"
#include "validation/either.h"
#include "validation/kernel_checks.h"
#include "validation/rdb_winners.h"
#include "validation/stage_input.h"
#include "validation/work.h"

namespace defray::validation {
namespace {

RayPlan scatter_plan(const Case& c) {
  RayPlan plan = ray_plan(c);
  plan.by = RaysBy::scatter;
  return plan;
}

/// Without jitter, whatever the case says: rdb_gather has none.
RayPlan gather_plan(const Case& c) {
  Case still = c;
  still.jitter = false;
  return ray_plan(still);
}

Outcome run_rdb_clear(Backend& backend, const Case& c, const Input&) {
  return integers(either(
      backend,
      [&](DeviceBackend& d) { return cleared_on_device(d.session(), c.width, c.height, c.cells); },
      [&] { return cleared_twin(c.width, c.height, c.cells); }));
}

Outcome run_rdb_scatter(Backend& backend, const Case& c, const Input& in) {
  const RayPlan plan = scatter_plan(c);
  return {either(
              backend,
              [&](DeviceBackend& d) { return winners_on_device(d.session(), in.fragments, plan); },
              [&] { return winners_of_twin(in.fragments, plan); }),
          {}};
}

/// A pass of so many rows with one cell.
std::size_t rdb_memory(const Case& c, const Input&) {
  return size(c.band_rows) * size(c.width) * rdb_bytes_a_pixel(1);
}

/// Means, and how many rays saw what the picture shows.
template <auto plan_of>
Outcome run_rays(Backend& backend, const Case& c, const Input& in) {
  RayResult result = backend.rays(in.fragments, plan_of(c));
  Outcome out = integers(result.seen);
  out.planes = std::move(result.means);
  return out;
}

/// The case's fragments; those that were made up have no data, and others that of any pixel.
template <auto plan_of>
Outcome run_nearest(Backend& backend, const Case& c, const Input& in) {
  Frame f = in.fragments;
  std::vector<std::uint32_t> data;
  for (std::size_t i = 0; i < f.coverage.size(); ++i) {
    const bool is_made_up = (f.coverage[i] & DEFRAY_SYNTHESISED) != 0;
    data.push_back(is_made_up ? DEFRAY_EMPTY : static_cast<std::uint32_t>(i));
  }
  f.data_of = std::move(data);
  RayPlan plan = plan_of(c);
  plan.wants_nearest = true;
  return integers(backend.rays(f, plan).nearest);
}

/// n additions to sums <= n L, each rounded, then a division, 5 u off at worst, u = 2^-24:
/// (n n L u) / n + 5 L u.
template <auto plan_of>
Exact exact_means(const Case& c, const Input& in) {
  const RayPlan plan = plan_of(c);
  const auto cells = static_cast<double>(plan.lens.points.size());
  return {reference::exact_rays(in.fragments, plan), cells + 5};
}

/// CoC radii of the least and of more than that, from column to column, and no hole in front.
Frame sparse_fragments(const Case& c, const Input& in) {
  constexpr int columns = 48;
  Frame f = in.fragments;
  std::vector<std::int32_t> coc(f.coc_quanta.begin(), f.coc_quanta.end());
  std::vector<std::uint32_t> coverage(f.coverage.begin(), f.coverage.end());
  for (std::size_t i = 0; i < coc.size(); ++i) {
    const std::size_t x = i % size(f.width);
    const auto more = static_cast<std::int32_t>((x / columns + c.seed) % 3) * (2 << 8);
    coc[i] += coc[i] < 0 ? -more : more;
    const bool is_front = i / size(f.width) % size(f.layers) == 0;
    if (is_front && !coverage.empty() && (coverage[i] & ~DEFRAY_SYNTHESISED) == 0) {
      coverage[i] = DEFRAY_WHOLE;
    }
  }
  f.coc_quanta = std::move(coc);
  f.coverage = std::move(coverage);
  return f;
}

Outcome run_between(Backend& backend, const Case& c, const Input& in) {
  RayPlan plan = gather_plan(c);
  plan.sparse_from = {1 << 8, 3 << 8};
  RayResult result = backend.rays(sparse_fragments(c, in), plan);
  Outcome out = integers(result.seen);
  out.planes = std::move(result.means);
  return out;
}

double between_work(const Case& c) { return rdb_work(c) + ray_tiles_work(c); }

/// Two products and their sum after the division.
double between_roundings(const Case& c) { return one_division(c) + 3; }

// Tiles of rdb_gather.

RayTiles tiles_of(Backend& backend, const Case& c, const Input& in) {
  const RayPlan plan = gather_plan(c);
  return either(
      backend, [&](DeviceBackend& d) { return d.ray_tiles(in.fragments, plan); },
      [&] { return reference::ray_tiles(in.fragments, plan); });
}

Outcome run_pad(Backend& backend, const Case& c, const Input& in) {
  const PaddedPlanes padded = tiles_of(backend, c, in).padded;
  Outcome out = integers(padded.keys);
  out.integers.insert(out.integers.end(), padded.largest.begin(), padded.largest.end());
  out.integers.insert(out.integers.end(), padded.sending.begin(), padded.sending.end());
  out.integers.insert(out.integers.end(), padded.coverage.begin(), padded.coverage.end());
  out.planes = padded.channels;
  return out;
}

/// Tile by tile, the words of both sets.
Outcome words_of(const std::vector<TileBins>& tiles) {
  Outcome out;
  for (const TileBins& tile : tiles) {
    for (const BinSet& set : {tile.plain, tile.special}) {
      for (const std::uint64_t word : set) {
        out.integers.push_back(static_cast<std::int64_t>(word));
      }
    }
  }
  return out;
}

Outcome run_ray_tiles(Backend& backend, const Case& c, const Input& in) {
  const RayTiles tiles = tiles_of(backend, c, in);
  Outcome out = words_of(tiles.held);
  out.integers.insert(out.integers.end(), tiles.least.begin(), tiles.least.end());
  out.integers.insert(out.integers.end(), tiles.special_rows.begin(), tiles.special_rows.end());
  return out;
}

Outcome run_ray_reach(Backend& backend, const Case& c, const Input& in) {
  return words_of(tiles_of(backend, c, in).reach);
}

constexpr const char* winners_rule = "equal winners: integer arithmetic";

}  // namespace

std::vector<KernelCheck> rdb_checks() {
  constexpr auto scatter = scatter_plan, gather = gather_plan;
  return {
      {"rdb_between", bits_rule, run_between, between_work, between_roundings, nullptr, rdb_memory},
      {"rdb_clear", integer_rule, run_rdb_clear, clear_work},
      {"rdb_gather", bits_rule, run_rays<gather>, rdb_work, one_division, exact_means<gather>,
       rdb_memory},
      {"rdb_gather_winners", integer_rule, run_nearest<gather>, rdb_work, nullptr, nullptr,
       rdb_memory},
      {"rdb_merge", bits_rule, run_rays<scatter>, rdb_work, one_division, exact_means<scatter>,
       rdb_memory},
      {"rdb_nearest", integer_rule, run_nearest<scatter>, rdb_work, nullptr, nullptr, rdb_memory},
      {"rdb_pad", integer_rule, run_pad, ray_tiles_work},
      {"rdb_reach", integer_rule, run_ray_reach, ray_tiles_work},
      {"rdb_scatter", winners_rule, run_rdb_scatter, rdb_work, nullptr, nullptr, rdb_memory},
      {"rdb_scatter_two_pass", winners_rule, run_rdb_scatter, rdb_work, nullptr, nullptr,
       rdb_memory, true},
      {"rdb_tiles", integer_rule, run_ray_tiles, ray_tiles_work},
  };
}

}  // namespace defray::validation
